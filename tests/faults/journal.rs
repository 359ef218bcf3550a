//! The journal: every change of a file or a name below the folder, in order and with its bytes. From it, the
//! state of a disk after a power cut can be derived. Records are those of `dragtraffic_tests::power`.
//!
//! Nothing is really synced while a journal is kept: the effect of a sync is derived from the journal alone.

use super::{is_below, open_plainly, path_of, plan};
use libc::{c_int, c_void, off_t, ssize_t};
use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};

const CREATED: u64 = 1;
const WRITTEN: u64 = 2;
const RESIZED: u64 = 3;
const SYNCED: u64 = 4;
const FOLDER_SYNCED: u64 = 5;
const RENAMED: u64 = 6;
const REMOVED: u64 = 7;

/// Held during a change: the journal has the changes in the order of the files.
static BUSY: AtomicBool = AtomicBool::new(false);
/// The open journal; -1 before it is open, -2 if there is none.
static JOURNAL: AtomicI32 = AtomicI32::new(-1);

struct Turn;

impl Turn {
    /// Waits for the lock. No change begins without power; one that began before is recorded.
    fn take() -> Self {
        while BUSY.swap(true, Ordering::Acquire) {
            std::hint::spin_loop();
        }
        if plan().is_some_and(|plan| plan.power.load(Ordering::Acquire) == 0) {
            end();
        }
        Self
    }
}

/// Ends the process as a power cut does.
fn end() {
    // SAFETY: calls without pointers.
    unsafe {
        libc::syscall(libc::SYS_kill, libc::syscall(libc::SYS_getpid), libc::SIGKILL);
    }
}

impl Drop for Turn {
    fn drop(&mut self) {
        BUSY.store(false, Ordering::Release);
    }
}

/// The open journal, if one is kept.
fn journal() -> Option<c_int> {
    let known = JOURNAL.load(Ordering::Acquire);
    if known != -1 {
        return (known >= 0).then_some(known);
    }
    // SAFETY: plain calls with checked results. Opening it twice at the same time is harmless.
    let file = unsafe {
        let path = libc::getenv(c"FAULTS_JOURNAL".as_ptr());
        if path.is_null() { -2 } else { open_plainly(path, libc::O_WRONLY | libc::O_APPEND) }
    };
    JOURNAL.store(if file < 0 { -2 } else { file }, Ordering::Release);
    (file >= 0).then_some(file)
}

/// Writes a record, and ends the process when the power fails.
fn note(journal: c_int, change: u64, (file, number): (u64, u64), first: &[u8], second: &[u8]) {
    let head = [change, file, number, first.len() as u64, second.len() as u64];
    let part =
        |bytes: *const u8, length: usize| libc::iovec { iov_base: bytes.cast_mut().cast(), iov_len: length };
    let parts = [
        part(head.as_ptr().cast(), size_of_val(&head)),
        part(first.as_ptr(), first.len()),
        part(second.as_ptr(), second.len()),
    ];
    let power = plan().map(|plan| &plan.power);
    let left = power
        .map(|power| power.fetch_update(Ordering::AcqRel, Ordering::Acquire, |left| left.checked_sub(1)));
    let whole = parts.iter().map(|part| part.iov_len).sum::<usize>() as i64;
    // SAFETY: the parts are valid for their lengths. An incomplete record ends the process, so none follows
    // it.
    let is_whole = unsafe { libc::syscall(libc::SYS_writev, journal, parts.as_ptr(), parts.len()) } == whole;
    // Another process may have made the last change during this one.
    if !is_whole || matches!(left, Some(Ok(1) | Err(_))) {
        end();
    }
}

/// Inode number of an open file, whether it is a folder, and its length.
fn number_of(file: c_int) -> Option<(u64, bool, off_t)> {
    // SAFETY: the kernel fills the structure, or the call fails.
    unsafe {
        let mut found: libc::stat = std::mem::zeroed();
        (libc::fstat(file, &raw mut found) == 0).then_some((
            found.st_ino,
            found.st_mode & libc::S_IFMT == libc::S_IFDIR,
            found.st_size,
        ))
    }
}

/// The journal, if it records changes of this open file.
fn kept(file: c_int) -> Option<c_int> {
    journal().filter(|_| path_of(file, &mut [0; 4096]).is_some_and(is_below))
}

/// Opens a file; records its creation.
pub fn opened(flags: c_int, open: impl FnOnce() -> c_int) -> c_int {
    let makes = flags & (libc::O_CREAT | libc::O_TRUNC) != 0;
    let Some(journal) = journal().filter(|_| makes) else { return open() };
    let _turn = Turn::take();
    let file = open();
    let mut path = [0; 4096];
    if let (true, Some(path), Some((number, _, _))) = (file >= 0, path_of(file, &mut path), number_of(file))
        && is_below(path)
    {
        // A known name with the same file is no change.
        let emptied = u64::from(flags & libc::O_TRUNC != 0);
        note(journal, CREATED, (number, emptied), path, &[]);
    }
    file
}

/// Writes bytes at an offset, or at the current position of the file.
pub fn written(
    file: c_int,
    bytes: *const c_void,
    at: Option<off_t>,
    write: impl FnOnce() -> ssize_t,
) -> ssize_t {
    let Some(journal) = kept(file) else { return write() };
    let _turn = Turn::take();
    let Some((number, _, size)) = number_of(file) else { return write() };
    // SAFETY: calls that only query.
    let at = at.unwrap_or_else(|| unsafe {
        let appends = libc::fcntl(file, libc::F_GETFL) & libc::O_APPEND != 0;
        if appends { size } else { libc::lseek(file, 0, libc::SEEK_CUR) }
    });
    let done = write();
    if let (Ok(count), Ok(at)) = (usize::try_from(done), u64::try_from(at)) {
        // SAFETY: that many bytes have just been read from there.
        let bytes = unsafe { std::slice::from_raw_parts(bytes.cast::<u8>(), count) };
        note(journal, WRITTEN, (number, at), bytes, &[]);
    }
    done
}

/// Changes the length of a file.
pub fn resized(file: c_int, length: off_t, resize: impl FnOnce() -> c_int) -> c_int {
    let Some(journal) = kept(file) else { return resize() };
    let _turn = Turn::take();
    let done = resize();
    if let (0, Some((number, _, _))) = (done, number_of(file)) {
        note(journal, RESIZED, (number, length.unsigned_abs()), &[], &[]);
    }
    done
}

/// Syncs a file or a folder: the journal records it, and no disk is waited for.
pub fn synced(file: c_int, sync: impl FnOnce() -> c_int) -> c_int {
    let mut path = [0; 4096];
    let journal = journal().zip(path_of(file, &mut path).filter(|path| is_below(path)));
    let (Some((journal, path)), Some((number, is_folder, _))) = (journal, number_of(file)) else {
        return sync();
    };
    let _turn = Turn::take();
    if plan().is_none_or(|plan| plan.lies.load(Ordering::Acquire) == 0) {
        note(journal, if is_folder { FOLDER_SYNCED } else { SYNCED }, (number, 0), path, &[]);
    }
    0
}

/// Gives a file another name.
pub fn renamed(from: &[u8], to: &[u8], rename: impl FnOnce() -> c_int) -> c_int {
    let Some(journal) = journal().filter(|_| is_below(to)) else { return rename() };
    let _turn = Turn::take();
    let done = rename();
    if done == 0 {
        note(journal, RENAMED, (0, 0), from, to);
    }
    done
}

/// Removes a name.
pub fn removed(path: &[u8], remove: impl FnOnce() -> c_int) -> c_int {
    let Some(journal) = journal().filter(|_| is_below(path)) else { return remove() };
    let _turn = Turn::take();
    let done = remove();
    if done == 0 {
        note(journal, REMOVED, (0, 0), path, &[]);
    }
    done
}
