//! `lightbvh gallery`: scenes by every method in equal time, next to references, as a page with a sheet of pictures for each.

mod fit;
mod job;
mod list;
mod measure;
mod page;
mod palette;
mod plan;
mod reference;
mod report;
mod sheet;
mod subject;

use std::collections::BTreeSet;
use std::path::Path;

use indicatif::ProgressBar;
use lightbvh::EmissiveTriangle;
use lightbvh::light::AnyLight;
use serde_json::{Value, json};

use super::compare::store::{Store, fingerprint, stem};
use super::trade::report::machine::{Made, command};
use super::{Context, Outcome, devices, progress, table};
use crate::cli::table::news;
use crate::error::HostError;
use crate::method::{MethodLight, Target};
use crate::render::write_whole;
use crate::vulkan::VulkanError;

use job::Job;
use list::{Entry, is_built_in};
use measure::measure;
pub(super) use plan::Args;
use plan::{BackendName, Equal, Plan};
use reference::Reference;
use report::{Exhibit, Measured, Report, Row, file_name};
use subject::{Opened, Subject};

/// Folders of pictures beside the page: of what the page shows, and of the rest.
const SHOWN: &str = "gallery";
const NOT_SHOWN: &str = "not-shown";

pub(super) fn run(context: &Context, args: &Args) -> Result<Outcome, HostError> {
    let plan = args.plan()?;
    if context.device.is_some() && args.backend == BackendName::Cpu {
        return Err(HostError::Usage {
            option: "--device",
            needs: "--backend vulkan",
        });
    }
    let opened = match args.backend {
        BackendName::Cpu => Vec::new(),
        BackendName::Vulkan => devices::open(context)?,
    };
    let target = match (args.backend, opened.first()) {
        (BackendName::Cpu, _) => Target::Cpu,
        (BackendName::Vulkan, Some(first)) => Target::Device(&first.device),
        (BackendName::Vulkan, None) => {
            return Err(VulkanError::NoDevice {
                notes: "--backend vulkan needs one".to_owned(),
            }
            .into());
        }
    };
    let store = Store::open(&args.out.join("results"))?;
    for folder in [SHOWN, NOT_SHOWN] {
        // The same, whatever it is for.
        Store::open(&args.out.join(folder))?;
    }
    let each = 2 + plan.methods.len() as u64 * (1 + u64::from(plan.seeds));
    let mut run = Run {
        plan: &plan,
        store,
        target,
        folder: &args.out,
        program: program(),
        progress: progress::bar(
            each * plan.entries.len() as u64,
            "{bar:30} {percent:>3} % {elapsed} passed, {eta} left  {wide_msg}",
            false,
        ),
        report: Report {
            made: Made {
                command: command(std::env::args().map(|word| without_folders(&word))),
                ..Made::now()
            },
            settings: settings(&plan, target.name()),
            notes: &report::NOTES,
            scenes: Vec::new(),
            failed: Vec::new(),
            computed: 0,
            reused: 0,
        },
        told: Vec::new(),
    };
    let mut stems = BTreeSet::new();
    for (entry, listed) in &plan.entries {
        let stem = free_stem(&mut stems, &entry.scene);
        run.entry(entry, *listed, &stem)?;
    }
    run.progress.finish_and_clear();
    let (report, told) = (run.report, run.told);
    devices::close(opened)?;

    let text = page::page(&plan, &report);
    let mut json = serde_json::to_vec_pretty(&report).map_err(std::io::Error::from)?;
    json.push(b'\n');
    for (name, bytes) in [("gallery.json", json.as_slice()), ("gallery.md", text.as_bytes())] {
        let path = args.out.join(name);
        write_whole(&path, bytes).map_err(|source| HostError::Store { path, source })?;
    }
    if context.json {
        table::print_json(&report)?;
    } else {
        table::print_text(&text)?;
    }
    for failed in told {
        news!("not rendered: {failed}");
    }
    Ok(Outcome::good_if(report.failed.is_empty()))
}

struct Run<'a> {
    plan: &'a Plan,
    store: Store,
    target: Target<'a>,
    folder: &'a Path,
    program: String,
    progress: ProgressBar,
    report: Report,
    /// What is wrong with scenes, with the folders of their files.
    told: Vec<String>,
}

impl Run<'_> {
    /// One scene; what is wrong with it goes into its row. An error is one of the folder, which all scenes would meet.
    fn entry(&mut self, entry: &Entry, listed: bool, stem: &str) -> Result<(), HostError> {
        let frame = entry.frame.unwrap_or(self.plan.frame);
        let built_in = is_built_in(&entry.scene);
        let mut exhibit = Exhibit::new(entry, listed, frame, built_in, subject::asset(entry));
        match self.measured(entry, frame, stem, &exhibit.title) {
            Ok(measured) => exhibit.measured = Some(measured),
            Err(error @ (HostError::Store { .. } | HostError::Folder { .. })) => return Err(error),
            Err(error) => {
                // Who runs the program is told the folders, which the report keeps to itself.
                self.told.push(format!("{}: {error}", exhibit.scene));
                let error = nameless(&error.to_string(), entry);
                self.report.failed.push(format!("{}: {error}", exhibit.scene));
                exhibit.error = Some(error);
            }
        }
        self.report.scenes.push(exhibit);
        Ok(())
    }

    fn measured(
        &mut self,
        entry: &Entry,
        frame: u32,
        stem: &str,
        title: &str,
    ) -> Result<Measured, HostError> {
        self.progress.set_message(format!("{stem}: opened"));
        let opened = subject::open(entry)?;
        for warning in opened.scene.warnings().iter().chain(&opened.scene.unseen_glass()) {
            news!("{stem}: {warning}");
        }
        if opened.scene.has_kinds() {
            self.by::<AnyLight>(entry, &opened, frame, stem, title)
        } else {
            self.by::<EmissiveTriangle>(entry, &opened, frame, stem, title)
        }
    }

    fn by<L: MethodLight>(
        &mut self,
        entry: &Entry,
        opened: &Opened,
        frame: u32,
        stem: &str,
        title: &str,
    ) -> Result<Measured, HostError> {
        let (plan, scene) = (self.plan, &opened.scene);
        let subject: Subject<'_, L> = Subject::new(scene, frame, (plan.width, plan.height))?;
        let job = Job {
            plan,
            store: &self.store,
            target: self.target,
            program: &self.program,
            stem,
            print: subject::print(opened, [subject.first, frame]),
            frame,
            progress: &self.progress,
        };
        let reference = Reference::of(&job, &subject)?;
        let results = measure(&job, &subject, &reference)?;
        let folder = if entry.may_be_shown { SHOWN } else { NOT_SHOWN };
        let picture = format!("{folder}/{stem}.png");
        // What was shown once and may not be any more.
        if !entry.may_be_shown {
            let _ = std::fs::remove_file(self.folder.join(format!("{SHOWN}/{stem}.png")));
        }
        let drawn = sheet::write(
            &self.folder.join(&picture),
            title,
            &reference.judge,
            &results.shown,
        )?;
        self.report.computed += results.computed;
        self.report.reused += results.reused;
        let (region, of_region) = drawn.map_or((None, Vec::new()), |(region, of)| (Some(region), of));
        let mut of_region = of_region.into_iter();
        let rows = results.shown.into_iter();
        let warnings = scene.warnings().iter().map(|warning| nameless(warning, entry));
        Ok(Measured {
            triangles: scene.triangle_count(),
            emissive_triangles: scene.emissive_count(),
            lights_by_formula: scene.analytic_count(),
            warnings: warnings.chain(reference.darkness).collect(),
            exposure: reference.judge.exposure(),
            reference: reference.noise,
            picture: region.map(|_| picture),
            region,
            methods: rows
                .filter_map(|of| Row::of(of.method, of.chosen, of.images, of_region.next()))
                .collect(),
            skipped: results.skipped,
        })
    }
}

/// A name for a scene's files that no other scene of the run has.
fn free_stem(taken: &mut BTreeSet<String>, scene: &str) -> String {
    let plain = stem(scene);
    let numbered = (2..).map(|number| format!("{plain}-{number}"));
    let mut names = std::iter::once(plain.clone()).chain(numbered);
    let free = names.find(|name| !taken.contains(name)).unwrap_or(plain);
    taken.insert(free.clone());
    free
}

/// A word of the command line, without the folders of a path in it.
fn without_folders(word: &str) -> String {
    match word.split_once('=') {
        Some((option, value)) if option.starts_with("--") => format!("{option}={}", file_name(value)),
        _ => file_name(word),
    }
}

/// A message without the folders of the entry's files.
fn nameless(message: &str, entry: &Entry) -> String {
    let mut message = message.to_owned();
    for path in [Some(&entry.scene), entry.environment.as_ref()]
        .into_iter()
        .flatten()
    {
        message = message.replace(path.as_str(), &file_name(path));
        if let Some(folder) = Path::new(path).parent().and_then(Path::to_str)
            && folder.len() > 1
        {
            message = message.replace(&format!("{folder}/"), "");
        }
    }
    message
}

/// Tells this program from others, whose results may differ: its own file's bytes.
fn program() -> String {
    let own = std::env::current_exe().and_then(std::fs::read);
    // Without them the version must do.
    fingerprint(&own.unwrap_or_else(|_| env!("CARGO_PKG_VERSION").into()))
}

fn settings(plan: &Plan, backend: &str) -> Value {
    let (time, samples) = match plan.equal {
        Equal::Time(ms) => (Some(ms), None),
        Equal::Samples(samples) => (None, Some(samples)),
    };
    json!({
        "time_ms": time, "samples": samples, "width": plan.width, "height": plan.height, "seeds": plan.seeds,
        "reference_samples": plan.reference_samples, "methods": plan.methods, "backend": backend,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_of_one_name_have_files_of_their_own() {
        let mut taken = BTreeSet::new();
        let names = [
            "a/scene.gltf",
            "b/scene.gltf",
            "Scene-2.glb",
            "c/scene.glb",
            "street",
        ];
        let stems = names.map(|name| free_stem(&mut taken, name));
        assert_eq!(stems, ["scene", "scene-2", "scene-2-2", "scene-3", "street"]);
    }

    #[test]
    fn no_folder_is_told() {
        assert_eq!(without_folders("/some/where/a.glb"), "a.glb");
        assert_eq!(without_folders("--list=some/where/a.json"), "--list=a.json");
        assert_eq!(without_folders("--time"), "--time");
        assert_eq!(without_folders("street"), "street");
        let entry = Entry::named("/some/where/a.glb");
        let told = nameless("cannot read /some/where/a.glb: no; nor /some/where/b.bin", &entry);
        assert_eq!(told, "cannot read a.glb: no; nor b.bin");
    }
}
