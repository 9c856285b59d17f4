//! A small file system, to be filled.

use std::path::Path;
use std::process::Command;

/// A file system of its own, unmounted in the end.
pub struct Disk<'a>(&'a Path);

impl<'a> Disk<'a> {
    /// Mounted at a folder, if that is permitted here.
    pub fn mount(kilobytes: u32, at: &'a Path) -> Option<Self> {
        std::fs::create_dir_all(at).ok()?;
        let size = format!("size={kilobytes}k");
        let mut mount = Command::new("mount");
        mount.args(["-t", "tmpfs", "-o", &size, "tmpfs"]).arg(at);
        let mounted = mount.output().ok()?;
        mounted.status.success().then_some(Disk(at))
    }
}

impl Disk<'_> {
    /// Makes room.
    pub fn grow(&self, kilobytes: u32) {
        let size = format!("remount,size={kilobytes}k");
        let mut mount = Command::new("mount");
        let grown = mount.args(["-o", &size]).arg(self.0).status();
        assert!(grown.expect("mount").success());
    }
}

impl Drop for Disk<'_> {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(self.0).status();
    }
}
