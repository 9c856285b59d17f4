//! `sph compare`: whether two runs have the same bits, or where they differ most.

mod difference;

use std::path::Path;

use serde_json::json;
use sph_core::number;
use sph_io::{Checkpoint, IoError};
use sph_run::CHECKPOINT;

use crate::terminal::{CommandOutput, Trouble, table};
use difference::{Difference, Table, differences};

#[derive(Default)]
struct Comparison {
    /// Of every column that both have, in the order of the files.
    columns: Vec<Difference>,
    /// Results of one of them alone, and numbers of rows that differ.
    remarks: Vec<String>,
}

pub fn command(first: &Path, second: &Path, json: bool) -> Result<(), Trouble> {
    let (told, same) = output(first, second)?;
    told.print(json);
    match same {
        true => Ok(()),
        false => Err(Trouble::Different),
    }
}

/// Prints the differences between the results of two runs; true for equal results.
pub fn output(first: &Path, second: &Path) -> Result<(CommandOutput, bool), Trouble> {
    let found = compared(first, second)?;
    let same = found.remarks.is_empty() && found.columns.iter().all(|c| c.same);
    let told = CommandOutput {
        json: json!({ "same": same, "columns": found.columns, "remarks": found.remarks }),
        text: text(&found, same, [first, second]),
    };
    Ok((told, same))
}

fn compared(first: &Path, second: &Path) -> Result<Comparison, Trouble> {
    if let Some(gone) = [first, second].iter().find(|folder| !folder.is_dir()) {
        return Err(format!("there is no folder of results {}", gone.display()).into());
    }
    let mut all = Comparison::default();
    let mut files = 0;
    for file in ["series.csv", "fields.pvd", CHECKPOINT] {
        match (first.join(file).is_file(), second.join(file).is_file()) {
            (false, false) => continue,
            (true, true) => {}
            (in_first, _) => {
                let only = if in_first { first } else { second };
                let only = only.display();
                all.remarks.push(format!("{file} is in {only} alone"));
                continue;
            }
        }
        files += 1;
        let [a, b] = [first, second].map(|folder| folder.join(file));
        all.add(file, &a, &b).map_err(|e| e.to_string())?;
    }
    match files {
        0 => Err(Trouble::usage(format!(
            "{} and {} have no file of results in common (series.csv, fields.pvd, {CHECKPOINT})",
            first.display(),
            second.display()
        ))),
        _ => Ok(all),
    }
}

impl Comparison {
    /// A file that both folders have; of tables row by row of the same key.
    fn add(&mut self, file: &str, a: &Path, b: &Path) -> Result<(), IoError> {
        let read: fn(&Path) -> Result<Table, IoError> = match file {
            "fields.pvd" => return self.fields(a, b),
            "series.csv" => |path| sph_io::read_table(path).map(Table::of_series),
            _ => |path| Checkpoint::load(path).map(Table::of_checkpoint),
        };
        let (columns, remarks) = differences(file, &read(a)?, &read(b)?);
        self.columns.extend(columns);
        self.remarks.extend(remarks);
        Ok(())
    }

    /// The frames that both lists have, by their times; of every column the frame that differs most.
    fn fields(&mut self, a: &Path, b: &Path) -> Result<(), IoError> {
        let [listed, other] = [sph_io::list_pvd(a)?, sph_io::list_pvd(b)?];
        let mut largest: Vec<Difference> = Vec::new();
        let mut common = 0;
        let mut remarks: Vec<(String, f64, usize)> = Vec::new();
        for one in &listed {
            let same = |l: &&sph_io::SeriesEntry| l.time == one.time && l.name == one.name;
            let Some(twin) = other.iter().find(same) else {
                continue;
            };
            common += 1;
            let [a, b] =
                [&one.path, &twin.path].map(|p| sph_io::read_piece(p).map(Table::of_piece));
            let (columns, told) = differences(&format!("fields of {}", one.name), &a?, &b?);
            for remark in told {
                match remarks.iter_mut().find(|(known, ..)| *known == remark) {
                    Some((.., frames)) => *frames += 1,
                    None => remarks.push((remark, one.time, 1)),
                }
            }
            for column in columns {
                let before = largest.iter_mut().find(|l| l.is_of(&column));
                match before {
                    Some(before) => before.keep_larger(column),
                    None => largest.push(column),
                }
            }
        }
        for (remark, time, frames) in remarks {
            let time = number::plain(time);
            self.remarks.push(match frames {
                1 => format!("{remark} at t = {time} s"),
                n => format!("{remark} in {n} frames from t = {time} s"),
            });
        }
        let lone = listed.len() + other.len() - 2 * common;
        if lone > 0 {
            let why = format!("fields.pvd: {lone} pieces have no counterpart at their time");
            self.remarks.push(why);
        }
        self.columns.extend(largest);
        Ok(())
    }
}

fn text(found: &Comparison, same: bool, folders: [&Path; 2]) -> String {
    let [a, b] = folders.map(|f| f.display().to_string());
    let count = found.columns.len();
    if same {
        return format!("the same bits in {count} columns of {a} and {b}\n");
    }
    let alike = found.columns.iter().filter(|c| c.same).count();
    let mut text = format!("{a} and {b} differ; {alike} of {count} columns have the same bits\n");
    let heads = "file, column, largest difference, of the range, first, second, where";
    if alike < count {
        let rows = found.columns.iter().filter(|c| !c.same);
        text.push_str(&table(heads, rows.map(Difference::row)));
    }
    for remark in &found.remarks {
        text.push_str(&format!("  {remark}\n"));
    }
    text
}
