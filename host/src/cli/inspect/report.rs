//! What `lightbvh inspect` says.

use lightbvh::requirements::{Model, Requirements};
use lightbvh_kernels::bvh::WIDTH;
use serde_json::{Value, json};

use super::light_kinds::LightKinds;
use super::motion::Motion;
use super::options::Args;
use super::ratio::MeanRatio;
use super::said::{self, Fact};
use super::steps::{Checked, Cost, MOST_VARIANCE, Promise, Step};
use super::surfaces::Surfaces;
use crate::cli::measure::NOT_MEASURED;
use crate::cli::measure::interval::Interval;
use crate::cli::table;
use crate::error::HostError;

/// Everything that is said.
pub(super) struct Report<'a> {
    pub args: &'a Args,
    /// Its name.
    pub scene: &'a str,
    /// How many were looked at.
    pub points: u32,
    /// The frame in which they were.
    pub moved: u32,
    pub motion: Motion,
    /// All of the file.
    pub animations: Value,
    pub surfaces: Surfaces,
    /// Where there are other lights than triangles.
    pub kinds: Option<LightKinds>,
    pub requirements: Requirements,
    pub chosen: Model,
    /// Whether another was asked for.
    pub asked_for: bool,
    /// The command that compiles the model's kernels, where they are not committed.
    pub kernels: Option<String>,
    pub checked: Checked,
}

impl Report<'_> {
    /// Whether bits are equal wherever that is promised. What costs more variance than promised is put back, or was asked for.
    pub fn holds(&self) -> bool {
        let steps = &self.checked.steps;
        steps
            .iter()
            .all(|step| step.held || step.promise == Promise::Variance)
    }

    fn facts(&self) -> Vec<Fact> {
        said::facts(&self.requirements, self.surfaces.glossy > 0)
    }

    fn reasons(&self) -> Vec<String> {
        said::reasons(&self.requirements, self.surfaces.glossy > 0)
    }

    pub fn json(&self) -> Value {
        let Checked { default, cost, .. } = self.checked;
        json!({
            "scene": self.scene, "frame": self.args.frame, "checked_frame": self.moved, "points": self.points,
            "lights": self.requirements.lights,
            "facts": self.facts(),
            "motion": self.motion,
            "animations": self.animations,
            "surfaces": self.surfaces,
            "kinds": self.kinds.map(|kinds| json!({
                "said": kinds.said(), "narrow": kinds.narrow, "light": kinds.light_type(), "node": kinds.node_type(WIDTH),
            })),
            "chosen": model_json(&self.chosen),
            "reasons": self.reasons(),
            "model": model_json(&self.checked.model),
            "overridden": self.asked_for,
            "kernels": { "committed": self.kernels.is_none(), "command": self.kernels },
            "default": { "variance": self.checked.variance, "cost": default },
            "steps": self.checked.steps,
            "saved": {
                "bytes_per_light": default.bytes_per_light - cost.bytes_per_light,
                "memory_per_light": default.memory_per_light - cost.memory_per_light,
                "ns_per_sample": cost.ns_saved,
            },
            "holds": self.holds(),
        })
    }

    pub fn print(&self) -> Result<(), HostError> {
        let mut text = format!(
            "{} in frame {}, {} emissive triangles\n\nwhat it requires\n",
            self.scene, self.args.frame, self.requirements.lights
        );
        let [gloss, masks] = self.surfaces.said();
        for Fact { name, found, reason } in self.facts() {
            let reason = match name {
                "glossy receivers" => &gloss,
                _ => &reason,
            };
            text += &line(name, &format!("{found}: {reason}"));
        }
        text += &line("masks", &masks);
        text += &line("animation", &self.motion.said());
        for note in self.motion.notes() {
            text += &line("", &note);
        }
        text += &format!("\nthe smallest model that is sufficient: {}\n", self.chosen);
        for reason in self.reasons() {
            text += &format!("  {reason}\n");
        }
        if let Some(kinds) = &self.kinds {
            text += &format!(
                "a tree over its lights of all kinds: Bvh<{}, Defensive<Moments, 6>, {WIDTH}>\n  lights: {}; {} of them send their light into a \
                 cone of less than 90 degrees\n",
                kinds.node_type(WIDTH),
                kinds.said(),
                kinds.narrow
            );
        }
        table::print_text(&text)?;
        self.print_check()?;
        self.print_model()
    }

    /// What is left after the check, and its kernels.
    fn print_model(&self) -> Result<(), HostError> {
        let model = &self.checked.model;
        let how = match (self.asked_for, *model == self.chosen) {
            (true, _) => "as asked for",
            (false, true) => "as chosen",
            (false, false) => "less what was put back",
        };
        let mut text = format!("\nmodel, {how}: {model}\n");
        text += &match &self.kernels {
            None => "kernels for devices: committed\n".to_owned(),
            Some(command) => {
                format!("kernels for devices: not committed; they are compiled by\n  {command}\n")
            }
        };
        Ok(table::print_text(&text)?)
    }

    /// The default, and each part that is another, one after the other.
    fn print_check(&self) -> Result<(), HostError> {
        let Checked {
            variance,
            default,
            cost,
            steps,
            ..
        } = &self.checked;
        if variance.is_none() {
            table::print_text(&format!(
                "\nfrom {} points on surfaces: {NOT_MEASURED}; what parts promise of the variance is not known to hold\n",
                self.points
            ))?;
        }
        if steps.is_empty() {
            let Cost {
                bytes_per_light,
                memory_per_light,
                ns_per_sample,
                ..
            } = default;
            return Ok(table::print_text(&format!(
                "\nthat is the default, with nothing to save: {bytes_per_light:.1} bytes per light, {memory_per_light:.1} in all arrays, \
                 {ns_per_sample:.0} ns per sample, variance {}\n",
                table::known(*variance, 4)
            ))?);
        }
        let refitted = if self.moved == self.args.frame {
            String::new()
        } else {
            format!(" in frame {}, after a refit", self.moved)
        };
        table::print_text(&format!(
            "\nchecked from {} points on surfaces{refitted}, one part after the other\n",
            self.points
        ))?;
        let first = std::iter::once(Row {
            variance: *variance,
            cost: *default,
            step: None,
        });
        let rest = steps.iter().map(|step| Row {
            variance: step.variance,
            cost: step.cost,
            step: Some(step.clone()),
        });
        table::print(&first.chain(rest).collect::<Vec<_>>(), COLUMNS)?;
        let Interval { median, low, high } = cost.ns_saved;
        let noise = if low <= 0.0 && high >= 0.0 { ": noise" } else { "" };
        table::print_text(&format!(
            "saved against the default: {:.1} of {:.1} bytes per light that sampling reads, {:.1} of {:.1} in all arrays, {median:.1} of {:.1} \
             ns per sample (95 %: {low:.1} to {high:.1}{noise})\n",
            default.bytes_per_light - cost.bytes_per_light,
            default.bytes_per_light,
            default.memory_per_light - cost.memory_per_light,
            default.memory_per_light,
            default.ns_per_sample,
        ))?;
        for step in steps.iter().filter(|step| !step.held) {
            let done = if step.put_back && step.part == "uniform share" {
                "it is put back, and trails stay for it"
            } else if step.put_back {
                "the part is put back"
            } else if step.promise == Promise::Variance {
                "kept, as asked for"
            } else {
                "this is a fault of lightbvh; please report it"
            };
            table::print_text(&format!(
                "{}: the promise of {} does not hold here, {done}\n",
                step.part,
                promise(step.promise)
            ))?;
        }
        Ok(())
    }
}

/// A line of what is required.
pub(super) fn line(name: &str, text: &str) -> String {
    format!("  {name:<20} {text}\n")
}

/// A line of the check: the default, then each step.
struct Row {
    variance: Option<f64>,
    cost: Cost,
    step: Option<Step>,
}

impl Row {
    fn of_step(&self, said: impl Fn(&Step) -> String) -> String {
        self.step.as_ref().map_or_else(|| "-".to_owned(), said)
    }
}

const COLUMNS: &[table::Column<Row>] = &[
    ("part", |r| {
        r.step.as_ref().map_or("default", |s| s.part).to_owned()
    }),
    ("promise", |r| r.of_step(|s| promise(s.promise))),
    ("holds", |r| r.of_step(|s| table::yes(s.held))),
    ("compared", |r| r.of_step(|s| s.compared.to_string())),
    ("different", |r| r.of_step(|s| s.different.to_string())),
    ("variance", |r| table::known(r.variance, 4)),
    ("times, 95 %", |r| {
        r.of_step(|s| match s.variance_ratio {
            Some(MeanRatio { ratio, low, high }) => format!("{ratio:.3} [{low:.3}, {high:.3}]"),
            None => table::known(None, 3),
        })
    }),
    ("bytes/light", |r| format!("{:.1}", r.cost.bytes_per_light)),
    ("all arrays", |r| format!("{:.1}", r.cost.memory_per_light)),
    ("sample ns", |r| format!("{:.1}", r.cost.ns_per_sample)),
];

fn promise(promise: Promise) -> String {
    match promise {
        Promise::Bits => "equal bits".to_owned(),
        Promise::BitsBelowInstance => "equal bits below the instance".to_owned(),
        Promise::Variance => format!("variance surely up to {MOST_VARIANCE} times"),
    }
}

fn model_json(model: &Model) -> Value {
    json!({
        "type": model.type_name(),
        "layout": model.layout.name(),
        "levels": 2 - u32::from(model.single_level),
        "width": model.width,
        "uniform_halvings": model.uniform_halvings,
        "trails": model.trails,
        "updates": model.updates.name(),
    })
}
