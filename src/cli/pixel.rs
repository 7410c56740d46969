//! A pixel as it is written.

/// `X,Y`: column and row, from 0 at the upper left.
///
/// # Errors
///
/// What a pixel is, where the text is none.
pub(super) fn pixel(text: &str) -> Result<[usize; 2], String> {
    let whole = |number: &str| number.trim().parse::<usize>().ok();
    let pixel = text.split_once(',').and_then(|(x, y)| Some([whole(x)?, whole(y)?]));
    pixel.ok_or_else(|| {
        "a pixel is its column and its row, such as 640,420, both from 0 at the upper left".into()
    })
}
