//! The fewest of some things with which something still holds.

use crate::error::Result;

/// Leaves out what can be left out, larger parts first; `holds` tells whether it still does with some of them. It does with all of `items`.
pub(super) fn fewest<T: Clone>(
    mut items: Vec<T>,
    holds: &mut dyn FnMut(&[T]) -> Result<bool>,
) -> Result<Vec<T>> {
    let mut part = items.len().div_ceil(2);
    while part > 0 && !items.is_empty() {
        let mut start = 0;
        while start < items.len() {
            let end = (start + part).min(items.len());
            let rest = [&items[..start], &items[end..]].concat();
            if holds(&rest)? {
                items = rest;
            } else {
                start = end;
            }
        }
        part = if part == 1 { 0 } else { part.div_ceil(2) };
    }
    Ok(items)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_something_hangs_on_is_left_and_little_is_asked_for_it() {
        let mut asked = 0;
        let left = fewest((0..1000).collect(), &mut |some: &[i32]| {
            asked += 1;
            Ok(some.contains(&17) && some.contains(&800))
        });
        assert_eq!(left.unwrap(), [17, 800]);
        assert!(asked < 60, "{asked}");
    }

    #[test]
    fn nothing_is_left_where_nothing_matters() {
        assert_eq!(fewest(vec![1, 2, 3], &mut |_| Ok(true)).unwrap(), [0; 0]);
    }
}
