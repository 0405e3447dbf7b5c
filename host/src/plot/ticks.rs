//! Round numbers along an axis.

/// A range from round number to round number around `least..=most`, and the numbers to mark in it: steps of 1, 2 or 5 times
/// a power of ten, about `count` of them.
pub fn ticks(least: f64, most: f64, count: usize) -> Vec<f64> {
    let span = if most > least {
        most - least
    } else {
        most.abs().max(1.0)
    };
    let rough = span / count.max(1) as f64;
    let unit = 10.0_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|m| m * unit)
        .find(|step| *step >= rough * 0.999)
        .unwrap_or(10.0 * unit);
    let first = (least / step + 1e-9).floor();
    let last = ((least + span) / step - 1e-9).ceil();
    (0..=(last - first) as u32)
        .map(|i| (first + f64::from(i)) * step)
        .collect()
}

/// A number with as many decimals as the step between marks needs.
pub fn label(value: f64, step: f64) -> String {
    let decimals = (-step.log10().floor()).clamp(0.0, 9.0) as usize;
    format!("{value:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_round_and_enclose_the_values() {
        assert_eq!(ticks(0.0, 846.48, 5), [0.0, 200.0, 400.0, 600.0, 800.0, 1000.0]);
        let marks = ticks(0.462, 0.542, 4);
        let labels: Vec<String> = marks.iter().map(|&m| label(m, 0.02)).collect();
        assert_eq!(labels, ["0.46", "0.48", "0.50", "0.52", "0.54", "0.56"]);
        // One value alone still makes an axis.
        assert!(ticks(3.0, 3.0, 4).len() >= 2);
        assert!(ticks(0.0, 0.0, 4).len() >= 2);
    }
}
