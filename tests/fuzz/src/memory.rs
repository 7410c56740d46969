//! The limit on memory, kept to the byte: libFuzzer itself looks only once a second.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// What one input may hold, in bytes.
const MOST: usize = 1 << 30;

struct Counted;

#[global_allocator]
static COUNTED: Counted = Counted;

static HELD: AtomicUsize = AtomicUsize::new(0);

fn take(bytes: usize) {
    let before = HELD.fetch_add(bytes, Relaxed);
    if before + bytes > MOST && before <= MOST {
        panic!("{bytes} bytes are asked for beside the {before} that are held: over the limit of {MOST}");
    }
}

// SAFETY: all is handed on to the system's allocator as it came; only sizes are added up. A panic here comes before anything is
// allocated (and ends the process: libFuzzer aborts on panics).
unsafe impl GlobalAlloc for Counted {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        take(layout.size());
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        take(layout.size());
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        HELD.fetch_sub(layout.size(), Relaxed);
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        HELD.fetch_sub(layout.size(), Relaxed);
        take(size);
        unsafe { System.realloc(pointer, layout, size) }
    }
}
