//! The known answers in `tests/data/known`, on the CPU and on every device: they change only on purpose.

use std::collections::BTreeSet;

use lightbvh::Instance;
use lightbvh::node::NODE_FORMAT;
use lightbvh::trail::max_levels;
use lightbvh_host::vulkan::Options;
use lightbvh_kernels::bvh::{Paper, Standard, TriangleChoice, WIDTH};
use lightbvh_tests::devices::on_each_device;
use lightbvh_tests::known::tree::{Tree, light_of};
use lightbvh_tests::known::{FILES, File, Subject, answer, answer_on, changes_to_bits, stated_node_format};
use lightbvh_tests::self_test;

/// How a difference is to be taken.
const ADVICE: &str = "Results have changed. If that is wanted: an entry under \"Changes to bits\" in CHANGELOG.md, then \
                      `cargo run -p lightbvh-tests --example known_answers -- overwrite-answers`.";

#[test]
fn the_cpu_reproduces_every_word() {
    let mut differences = Vec::new();
    for (name, subject) in FILES {
        let file = File::read(name);
        let (compared, lines) = file.differences("the CPU", &answer(&file, subject));
        println!("{name}: {compared} words");
        assert!(compared > 400, "{name}: {compared} words");
        differences.extend(lines);
    }
    assert!(differences.is_empty(), "{}\n{ADVICE}", differences.join("\n"));
}

#[test]
fn the_self_test_that_engines_run_has_the_answers_of_this_build() {
    let words = self_test::words();
    let (operands, answers) = words.split_at(lightbvh_gpu::self_test::operands().len());
    assert_eq!(lightbvh_gpu::self_test::operands(), operands);
    assert_eq!(answers.len(), lightbvh_gpu::self_test::ANSWERS_BYTES);
    assert_eq!(lightbvh_gpu::self_test::defect(answers), None, "{ADVICE}");
}

#[test]
fn every_exact_device_reproduces_every_word() {
    on_each_device(Options::default(), |device| {
        if !device.self_test().expect("a verdict").exact {
            eprintln!("{}: not exact, its words are its own", device.name());
            return;
        }
        let mut differences = Vec::new();
        for (name, subject) in FILES {
            let file = File::read(name);
            if let Some(answers) = answer_on(device, &file, subject) {
                let (compared, lines) = file.differences(device.name(), &answers);
                println!("{}, {name}: {compared} words", device.name());
                differences.extend(lines);
            }
        }
        assert!(differences.is_empty(), "{}\n{ADVICE}", differences.join("\n"));
    });
}

#[test]
fn the_sweeps_of_the_cpu_refit_to_the_same_words() {
    fn swept<C: TriangleChoice<W>, const W: usize>(name: &str) {
        let file = File::read(name);
        let nodes = Tree::<C::Node, W>::read(&file).swept();
        let known = file.find("nodes").expect("nodes").output();
        assert!(bytemuck::cast_slice::<_, u32>(&nodes) == known, "{name}");
    }
    for (name, subject) in FILES {
        match subject {
            Subject::Tree => swept::<Standard, WIDTH>(name),
            Subject::PaperTree => swept::<Paper, 4>(name),
            _ => {}
        }
    }
}

/// Files of another node format, or that claim changes which the changelog does not have, were not written by this source.
#[test]
fn files_belong_to_this_version() {
    assert_eq!(
        stated_node_format(),
        Some(NODE_FORMAT),
        "the newest `NODE_FORMAT` under \"Changes to bits\""
    );
    for (name, _) in FILES {
        let file = File::read(name);
        assert_eq!(file.node_format, NODE_FORMAT, "{name}: node format; {ADVICE}");
        assert!(
            (1..=changes_to_bits()).contains(&file.changes_to_bits),
            "{name}: written at change {} of {}",
            file.changes_to_bits,
            changes_to_bits()
        );
    }
}

/// Nothing lies there that no test reads, files are written as they are read, and all of them are small.
#[test]
fn files_are_whole() {
    let folder = File::path("x").parent().expect("a folder").to_owned();
    let found: BTreeSet<String> = std::fs::read_dir(folder)
        .expect("the folder")
        .map(|entry| {
            entry
                .expect("an entry")
                .file_name()
                .into_string()
                .expect("a name")
        })
        .filter(|name| name.ends_with(".txt"))
        .collect();
    assert_eq!(
        found,
        FILES.iter().map(|(name, _)| format!("{name}.txt")).collect()
    );
    let mut bytes = 0;
    for (name, _) in FILES {
        let text = std::fs::read_to_string(File::path(name)).expect("a file");
        assert!(
            File::read(name).text() == text,
            "{name}: not as it would be written"
        );
        bytes += text.len();
    }
    assert!(bytes < 1 << 20, "{bytes} bytes");
}

/// What the trees are there for is in them.
#[test]
fn trees_hold_what_they_are_named_after() {
    for (name, subject) in FILES {
        match subject {
            Subject::Tree => holds_what_it_is_named_after::<Standard, WIDTH>(name),
            Subject::PaperTree => holds_what_it_is_named_after::<Paper, 4>(name),
            _ => {}
        }
    }
}

fn holds_what_it_is_named_after<C: TriangleChoice<W>, const W: usize>(name: &str) {
    let file = File::read(name);
    let tree = Tree::<C::Node, W>::read(&file);
    let (nodes, _) = tree.refitted();
    let (sampled, pmfs) = tree.queried::<C>(&nodes);
    let drawn: BTreeSet<u32> = sampled.iter().filter_map(light_of).collect();
    println!("{name}: depth {}, {} lights drawn", tree.depth(), drawn.len());
    assert!(drawn.len() > 5, "{name}: {} lights are drawn", drawn.len());
    assert!(tree.depth() <= tree.push.depth, "{name}");
    match name {
        "tree_deep" => assert_eq!(tree.depth(), 2 * max_levels(W)),
        "tree_instances" | "tree_eq4" => {
            assert!(tree.instances.iter().any(|i| i.mirrored == 1));
            assert!(tree.instances.iter().any(|i| i.radiance == 0.0));
            let flat = |i: &Instance| i.columns.contains(&[0.0; 3]);
            assert!(tree.instances.iter().any(flat));
            assert!(tree.push.live > 10);
        }
        "tree_two_levels" => assert!(tree.roots.len() > 5),
        _ => assert_eq!(tree.push.live, 0),
    }
    assert!(pmfs.iter().all(|pmf| (0.0..=1.0).contains(pmf)), "{name}");
    // A sample's pmf is that of its light.
    for (query, sampled) in tree.samples.iter().zip(&sampled) {
        let Some(light) = light_of(sampled) else { continue };
        let asked = tree
            .pmfs
            .iter()
            .position(|q| q.point == query.point && q.words[0] == light);
        if let Some(asked) = asked {
            assert_eq!(
                sampled.pmf.to_bits(),
                pmfs[asked].to_bits(),
                "{name}: light {light}"
            );
        }
    }
}

/// The image shows something, and nothing that is no number.
#[test]
fn the_image_is_lit() {
    let words = File::read("image").find("pixels").expect("pixels").output();
    let pixels: Vec<f32> = words.into_iter().map(f32::from_bits).collect();
    assert!(pixels.iter().all(|x| x.is_finite() && *x >= 0.0));
    let lit = pixels.iter().filter(|x| **x > 0.1).count();
    assert!(lit > 2000, "{lit} of {} channels", pixels.len());
}

#[test]
fn a_wrong_word_is_named_with_its_line() {
    let (name, subject) = FILES[0];
    let file = File::read(name);
    let mut answers = answer(&file, subject);
    answers[1].words[3] ^= 1;
    let (_, lines) = file.differences("it", &answers);
    let table = &file.tables[1];
    let text = std::fs::read_to_string(File::path(name)).expect("a file");
    let line = text.lines().nth(table.line + 2).expect("the row's line");
    let known = format!("{:08x}", table.output()[3]);
    assert!(line.ends_with(&known), "{line}");
    assert_eq!(lines.len(), 1);
    let expected = format!(
        "exact.txt, table {}, row 3 (line {}), word 1: the file says {known}",
        table.name,
        table.line + 3
    );
    assert!(lines[0].starts_with(&expected), "{lines:?}");
}

#[test]
fn files_that_are_no_files_are_refused() {
    let refused = |text: &str| File::parse("x", text).expect_err("refused");
    assert_eq!(refused("node_format 1\n00000000").0, 2);
    assert_eq!(refused("table t 1 1 1\n0000000g 00000000").0, 2);
    assert_eq!(refused("table t 1 1 1\n00000000").0, 2);
    assert_eq!(
        refused("table t 1 1 2\n00000000 00000000").1,
        "1 rows are missing"
    );
    assert_eq!(refused("node_format one").0, 1);
}
