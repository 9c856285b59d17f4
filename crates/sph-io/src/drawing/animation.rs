//! Pictures one after the other as an animated GIF.

use std::io::BufWriter;
use std::path::{Path, PathBuf};

use gif::{Encoder, Frame, Repeat};
use tiny_skia::Pixmap;

use crate::error::{IoError, Result};
use crate::files::disk::{Durability, writable, write_atomic};

/// Every tenth pixel counts for the 256 colours of a frame.
const SPEED: i32 = 10;
/// The last picture stands for so long, hundredths of a second.
const LAST: u16 = 150;

/// Wider pictures are shown at half their size: a film of them takes a quarter of the time and of the disk.
const WIDEST: u32 = 800;
/// Most pictures of a film; of more, every second, third, … is shown.
const MOST: usize = 400;

/// Joins the pictures of a run that are there to `animations/NAME.gif` in its folder; writes nothing if there are none.
///
/// # Errors
/// As [`write_gif`].
pub fn write_film(
    folder: &Path,
    name: &str,
    pictures: impl Iterator<Item = PathBuf>,
    frames_per_second: f64,
) -> Result<()> {
    let all: Vec<PathBuf> = pictures.filter(|p| p.is_file()).collect();
    if all.is_empty() {
        return Ok(());
    }
    writable(folder.join("animations"))?;
    let every = all.len().div_ceil(MOST);
    let shown: Vec<PathBuf> = all.into_iter().step_by(every).collect();
    let path = folder.join("animations").join(format!("{name}.gif"));
    write_gif(path, &shown, frames_per_second)
}

/// Writes the PNG `pictures` to `path` as a GIF that begins again after its end, all or nothing.
///
/// Every frame has 256 colours of its own. Pictures of more than 800 pixels in width are halved. Those that are smaller
/// than the largest stand in the upper left corner, on white. Delays are whole hundredths of a second.
///
/// # Errors
/// No picture at all, one that cannot be read, a file that cannot be written.
pub fn write_gif(
    path: impl AsRef<Path>,
    pictures: &[PathBuf],
    frames_per_second: f64,
) -> Result<()> {
    let path = path.as_ref();
    let refuse = |problem: String| IoError::input(path, problem);
    let mut sides = [0; 2];
    for picture in pictures {
        let map = read(picture)?;
        sides = [sides[0].max(map.width()), sides[1].max(map.height())];
    }
    let side = |n: u32| u16::try_from(n).map_err(|_| refuse(format!("{n} pixels are too many")));
    let (width, height) = (side(sides[0])?, side(sides[1])?);
    if width == 0 || height == 0 {
        return Err(refuse("there is no picture".into()));
    }
    let delay = (100.0 / frames_per_second).round().clamp(2.0, 6000.0) as u16;
    write_atomic(path, Durability::Process, |file| {
        let wrong = std::io::Error::other::<gif::EncodingError>;
        let mut encoder = Encoder::new(BufWriter::new(file), width, height, &[]).map_err(wrong)?;
        encoder.set_repeat(Repeat::Infinite).map_err(wrong)?;
        for (k, picture) in pictures.iter().enumerate() {
            let map = read(picture).map_err(std::io::Error::other)?;
            let mut pixels = on_white(&map, usize::from(width), usize::from(height));
            let mut frame = Frame::from_rgba_speed(width, height, &mut pixels, SPEED);
            let last = k + 1 == pictures.len();
            frame.delay = if last { delay.max(LAST) } else { delay };
            encoder.write_frame(&frame).map_err(wrong)?;
        }
        Ok(())
    })
}

/// The bytes of a picture on a larger white one. Pictures are opaque, so that multiplication with opacity changes
/// nothing.
fn on_white(map: &Pixmap, width: usize, height: usize) -> Vec<u8> {
    let mut pixels = vec![255; 4 * width * height];
    let row = 4 * map.width() as usize;
    let lines = pixels.chunks_exact_mut(4 * width);
    for (line, drawn) in lines.zip(map.data().chunks_exact(row)) {
        line[..row].copy_from_slice(drawn);
    }
    pixels
}

fn read(path: &Path) -> Result<Pixmap> {
    let bytes = std::fs::read(path).map_err(|e| IoError::read(path, e))?;
    let unfit = |e| IoError::Unfit(path.into(), format!("it is no picture: {e}"));
    let map = Pixmap::decode_png(&bytes).map_err(unfit)?;
    let wide = map.width() > WIDEST && map.height() > 1;
    Ok(wide.then(|| halved(&map)).flatten().unwrap_or(map))
}

/// A picture of half the width and height: every pixel is the mean of four.
fn halved(map: &Pixmap) -> Option<Pixmap> {
    let mut small = Pixmap::new(map.width() / 2, map.height() / 2)?;
    let (row, width) = (4 * map.width() as usize, 4 * small.width() as usize);
    let data = map.data();
    for (j, line) in small.data_mut().chunks_exact_mut(width).enumerate() {
        for (k, byte) in line.iter_mut().enumerate() {
            let at = 2 * j * row + 8 * (k / 4) + k % 4;
            let four = [at, at + 4, at + row, at + row + 4].map(|n| u32::from(data[n]));
            *byte = (four.iter().sum::<u32>() / 4) as u8;
        }
    }
    Some(small)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A picture of a colour and a width, and 20 pixels high.
    fn picture(folder: &Path, name: &str, width: u32, [r, g, b]: [u8; 3]) -> PathBuf {
        let mut map = Pixmap::new(width, 20).expect("a map");
        map.fill(tiny_skia::Color::from_rgba8(r, g, b, 255));
        let path = folder.join(name);
        map.save_png(&path).expect("saved");
        path
    }

    fn decoder(path: &Path) -> gif::Decoder<std::fs::File> {
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let file = std::fs::File::open(path).expect("there");
        options.read_info(file).expect("a GIF")
    }

    #[test]
    fn frames_come_back_with_their_size_order_and_delays() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |k: usize, colour| picture(folder.path(), &format!("{k}.png"), 30, colour);
        let pictures = [at(0, [255, 0, 0]), at(1, [0, 255, 0]), at(2, [0, 0, 255])];
        let path = folder.path().join("a.gif");
        write_gif(&path, &pictures, 12.5).expect("written");
        let mut decoder = decoder(&path);
        assert_eq!((decoder.width(), decoder.height()), (30, 20));
        let mut seen = Vec::new();
        while let Some(frame) = decoder.read_next_frame().expect("a frame") {
            seen.push((frame.delay, [0, 1, 2].map(|c| frame.buffer[c] > 127)));
        }
        let [t, f] = [true, false];
        assert_eq!(seen, [(8, [t, f, f]), (8, [f, t, f]), (LAST, [f, f, t])]);
    }

    #[test]
    fn wide_pictures_are_halved_to_the_mean_of_four_pixels() {
        let mut map = Pixmap::new(1001, 5).expect("a map");
        map.fill(tiny_skia::Color::WHITE);
        for byte in &mut map.data_mut()[..3] {
            *byte = 55;
        }
        let small = halved(&map).expect("a map");
        assert_eq!((small.width(), small.height()), (500, 2));
        assert_eq!(small.data()[..8], [205, 205, 205, 255, 255, 255, 255, 255]);
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("wide.png");
        map.save_png(&path).expect("saved");
        assert_eq!(read(&path).expect("read").width(), 500);
    }

    #[test]
    fn smaller_pictures_stand_on_white_and_nothing_is_written_of_what_is_none() {
        let folder = tempfile::tempdir().expect("a folder");
        let black = |name, width| picture(folder.path(), name, width, [0; 3]);
        let pictures = [black("0.png", 30), black("1.png", 20)];
        let path = folder.path().join("a.gif");
        write_gif(&path, &pictures, 10.0).expect("written");
        let mut decoder = decoder(&path);
        let mut last = |column: usize| {
            let frame = decoder.read_next_frame().expect("read").expect("a frame");
            [frame.buffer[0], frame.buffer[4 * column]]
        };
        assert_eq!((last(29), last(29)), ([0, 0], [0, 255]));
        std::fs::remove_file(&path).expect("there");
        assert!(write_gif(&path, &[], 10.0).is_err());
        assert!(write_gif(&path, &[folder.path().join("gone.png")], 10.0).is_err());
        assert!(!path.exists());
    }
}
