//! Times of several sides in turns, so that what else the machine does meets all alike.

use std::time::Duration;

use crate::cli::times::ms;
use crate::error::HostError;

/// Times of each of `sides`, ns per item of `items`, turn by turn; each turn begins with another side, so that none always
/// follows the same one.
pub(super) fn in_turns(
    sides: usize,
    turns: u32,
    items: u32,
    mut time: impl FnMut(usize) -> Result<Duration, HostError>,
) -> Result<Vec<Vec<f64>>, HostError> {
    let mut times = vec![Vec::new(); sides];
    for turn in 0..turns as usize {
        for k in 0..sides {
            let at = (k + turn) % sides;
            times[at].push(1e6 * ms(time(at)?) / f64::from(items));
        }
    }
    Ok(times)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_side_begins_as_often() {
        let mut order = Vec::new();
        let times = in_turns(3, 2, 4, |at| {
            order.push(at);
            Ok(Duration::from_nanos(8 * (at as u64 + 1)))
        });
        assert_eq!(order, [0, 1, 2, 1, 2, 0]);
        let times = times.expect("no side fails");
        for (at, of) in times.iter().enumerate() {
            let expected = 2.0 * (at as f64 + 1.0);
            assert!(
                of.len() == 2 && of.iter().all(|ns| (ns - expected).abs() < 1e-9),
                "{times:?}"
            );
        }
    }
}
