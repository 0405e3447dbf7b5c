//! `lightbvh gallery`, whole: its files, a scene that fails, credits, and how it goes on.

use serde_json::Value;

use crate::program::{Folder, json, refused, run};

const TINY: &str = "--size 32x18 --samples 2 --seeds 2 --reference-samples 8";

fn rows(scene: &Value) -> Vec<&str> {
    let methods = scene["methods"].as_array().expect("methods");
    methods
        .iter()
        .map(|row| row["method"].as_str().expect("a name"))
        .collect()
}

#[test]
fn a_run_leaves_a_page_numbers_and_pictures_and_goes_on_where_it_was() {
    let folder = Folder::new("gallery");
    let out = folder.file("out");
    let line = format!(
        "gallery street stage {TINY} --methods uniform,power,two-level-saoh,restir --out {out} --json"
    );
    let first = json(&line);
    let scenes = first["scenes"].as_array().expect("scenes");
    // The stage has lights of other kinds than the paper's importance knows.
    assert_eq!(rows(&scenes[0]), ["uniform", "power", "two-level-saoh", "restir"]);
    assert_eq!(rows(&scenes[1]), ["uniform", "power", "restir"]);
    assert_eq!(scenes[1]["skipped"][0]["method"], "two-level-saoh");
    assert!(
        scenes[1]["skipped"][0]["why"]
            .as_str()
            .is_some_and(|why| why.contains("triangles"))
    );
    for scene in scenes {
        assert!(scene["reference"]["mse"].as_f64() > Some(0.0), "{scene}");
        for row in scene["methods"].as_array().expect("methods") {
            let samples = if row["method"] == "restir" { 6 } else { 2 };
            assert_eq!(row["samples"], samples, "{row}");
            assert_eq!(row["images"].as_array().map(Vec::len), Some(2));
            let number =
                |of: &str, what: &str| row[of][what].as_f64().unwrap_or_else(|| panic!("{of} of {row}"));
            assert!(number("ms", "mean") > 0.0 && number("mse", "ci95") >= 0.0);
            assert!(
                number("mse", "least") <= number("mse", "mean")
                    && number("mse", "mean") <= number("mse", "most")
            );
        }
        let picture = scene["picture"].as_str().expect("a picture");
        assert!(
            image::open(folder.0.join("out").join(picture)).is_ok(),
            "{picture}"
        );
        let bytes = std::fs::metadata(folder.0.join("out").join(picture))
            .expect("a file")
            .len();
        assert!(bytes <= 60_000, "{bytes}");
    }
    let read = |name: &str| std::fs::read_to_string(folder.0.join("out").join(name)).expect(name);
    assert_eq!(
        serde_json::from_str::<Value>(&read("gallery.json")).expect("JSON"),
        first
    );
    let page = read("gallery.md");
    assert!(
        page.contains("](gallery/street.png)") && page.contains("](gallery/stage.png)"),
        "{page}"
    );
    let home = folder.0.to_str().expect("a path of text");
    assert!(!page.contains(home) && !read("gallery.json").contains(home));

    // Two images of each of seven methods.
    assert_eq!((&first["computed"], &first["reused"]), (&14.into(), &0.into()));
    let second = json(&line);
    assert_eq!((&second["computed"], &second["reused"]), (&0.into(), &14.into()));
    assert_eq!(second["scenes"], first["scenes"]);
    // An image is lost, and the picture of a first one: both are made again, to the bit.
    let results: Vec<_> = std::fs::read_dir(folder.0.join("out/results/street"))
        .expect("results")
        .collect();
    for (method, ending) in [("uniform-s01", ".json"), ("power-s00", ".exr")] {
        let file = results
            .iter()
            .map(|entry| entry.as_ref().expect("an entry").path())
            .find(|path| {
                let name = path.file_name().and_then(|name| name.to_str()).unwrap_or("");
                name.starts_with(method) && name.ends_with(ending)
            });
        std::fs::remove_file(file.expect(method)).expect("it goes");
    }
    let third = json(&line);
    assert_eq!((&third["computed"], &third["reused"]), (&2.into(), &12.into()));
    for (a, b) in third["scenes"].as_array().expect("scenes").iter().zip(scenes) {
        let errors = |scene: &Value| -> Vec<Value> {
            let methods = scene["methods"].as_array().expect("methods");
            methods.iter().map(|row| row["mse"].clone()).collect()
        };
        assert_eq!(errors(a), errors(b));
    }
}

#[test]
fn a_scene_that_fails_does_not_stop_the_others() {
    let folder = Folder::new("gallery-fails");
    let out = folder.file("out");
    let list = folder.file("list.json");
    assert!(
        run(&format!("export street -o {}", folder.file("mine.glb")))
            .status
            .success()
    );
    let text = r#"{ "scenes": [
        { "scene": "gone.glb", "title": "Gone", "may_be_shown": false },
        { "scene": "mine.glb", "title": "Mine", "author": "A. Name", "licence": "All rights reserved", "may_be_shown": false },
        { "scene": "street", "may_be_shown": true, "frame": 9 }
    ] }"#;
    std::fs::write(&list, text).expect("a file");
    let output = run(&format!(
        "gallery --list {list} {TINY} --methods two-level --out {out} --json"
    ));
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("not rendered: gone.glb"), "{said}");
    let report: Value = serde_json::from_slice(&output.stdout).expect("one JSON object");
    assert_eq!(report["failed"].as_array().map(Vec::len), Some(1));
    let scenes = report["scenes"].as_array().expect("scenes");
    assert!(
        scenes[0]["error"]
            .as_str()
            .is_some_and(|error| error.contains("gone.glb"))
    );
    assert_eq!(
        (&scenes[1]["error"], &scenes[2]["frame"]),
        (&Value::Null, &9.into())
    );
    assert_eq!(rows(&scenes[1]), ["two-level-moments"]);
    // What may not be shown is there, beside what may, and not in the page.
    assert!(folder.0.join("out/not-shown/mine.png").exists());
    assert!(!folder.0.join("out/gallery/mine.png").exists());
    let page = std::fs::read_to_string(folder.0.join("out/gallery.md")).expect("a page");
    assert!(
        !page.contains("mine.png") && page.contains("](gallery/street.png)"),
        "{page}"
    );
    assert!(page.contains("By A. Name, All rights reserved."), "{page}");
    assert!(
        page.contains("Could not be rendered: cannot read gone.glb"),
        "{page}"
    );
}

#[test]
fn equal_time_is_spent_in_whole_samples() {
    let folder = Folder::new("gallery-time");
    let report = json(&format!(
        "gallery street --size 32x18 --time 5 --seeds 1 --reference-samples 8 --methods uniform,two-level --out {} --json",
        folder.file("out")
    ));
    for row in report["scenes"][0]["methods"].as_array().expect("methods") {
        let samples = row["samples"].as_u64().expect("samples");
        let trials = row["trials"].as_array().expect("trials");
        assert!(samples >= 1 && !trials.is_empty(), "{row}");
        // Of one image there is no interval.
        assert!(
            row["mse"]["ci95"].is_null() && row["mse"]["mean"].as_f64() > Some(0.0),
            "{row}"
        );
    }
}

#[test]
fn bad_input_is_refused() {
    let folder = Folder::new("gallery-refused");
    let list = folder.file("list.json");
    std::fs::write(&list, "{ \"scenes\": [\n  { \"scene\": \"street\" }\n] }").expect("a file");
    for (options, expected) in [
        ("--time 0", "no finite number above 0"),
        ("--time 5 --samples 3", "cannot be used with"),
        ("--samples 0", "--samples 0"),
        ("--seeds 0", "--seeds 0"),
        ("--size 3", "no size such as"),
        ("--reference-samples 1", "--reference-samples 1"),
        ("--methods best", "best"),
        ("--frame 10001", "--frame 10001"),
        ("--list nowhere.json", "nowhere.json"),
        (&format!("--list {list}"), "line 2: missing field `may_be_shown`"),
        ("--device 0", "--device needs --backend vulkan"),
    ] {
        let said = refused(&format!("gallery {options} --out {}", folder.file("out")));
        assert!(said.contains(expected), "{options} said {said}");
    }
    assert!(!folder.0.join("out").exists());
    let help = String::from_utf8(run("gallery --help").stdout).expect("text");
    assert!(
        help.contains("\"may_be_shown\": true") && help.contains("--list <FILE>"),
        "{help}"
    );
}

/// The page is for others and tells no folders; who runs the program wants them.
#[test]
fn a_scene_that_cannot_be_read_is_named_with_its_folder() {
    let folder = Folder::new("gallery-folder");
    let out = folder.file("out");
    let output = run(&format!("gallery some/where/nope.glb --time 1 --out {out}"));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("cannot read some/where/nope.glb"), "{said}");
    let page = std::fs::read_to_string(folder.file("out/gallery.md")).expect("a page");
    assert!(!page.contains("some/where"), "{page}");
}
