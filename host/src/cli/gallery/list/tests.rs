use super::*;

fn refused(text: &str) -> String {
    parse(text).expect_err("a problem")
}

#[test]
fn an_entry_has_what_the_list_says_and_usual_values_for_the_rest() {
    let text = r#"{ "scenes": [
        { "scene": "a/lamp.glb", "title": "Lamp", "author": "A. Name", "licence": "CC0-1.0",
          "source": "https://example.org/lamp", "may_be_shown": true, "camera": 2, "frame": 30,
          "environment": "sky.hdr", "environment_scale": 0.5 },
        { "scene": "street", "may_be_shown": true }
    ] }"#;
    let entries = parse(text).expect("a list");
    let some = |text: &str| Some(text.to_owned());
    let lamp = Entry {
        scene: String::from("a/lamp.glb"),
        title: some("Lamp"),
        author: some("A. Name"),
        licence: some("CC0-1.0"),
        source: some("https://example.org/lamp"),
        may_be_shown: true,
        camera: 2,
        frame: Some(30),
        environment: some("sky.hdr"),
        environment_scale: 0.5,
    };
    assert_eq!(entries, [lamp, Entry::named("street")]);
}

#[test]
fn errors_name_the_line_and_what_to_do() {
    let entry = |line: &str| {
        format!("{{ \"scenes\": [\n  {{ \"scene\": \"a.glb\",\n{line}\n    \"may_be_shown\": false }}\n] }}")
    };
    // What stands in line 3, and what is said of it.
    for (line, what, advice) in [
        ("\"titel\": \"A\",", "unknown field `titel`", "`title`"),
        ("\"title\": 3,", "invalid type", "--help"),
        ("\"title\": \" \",", "is empty", "remove its key"),
        ("\"title\": \"a\\nb\",", "control character", "in one line"),
        ("\"source\": \"example.org\",", "no address", "https://"),
        ("\"source\": \"https://a.org/a b\",", "no address", "%20"),
        ("\"frame\": 10001,", "too large", "0 to 10000"),
        ("\"frame\": -1,", "invalid value", "--help"),
        ("\"environment_scale\": 0.0,", "no factor", "above 0"),
        ("\"title\" \"A\",", "expected `:`", "quotes and commas"),
    ] {
        let said = refused(&entry(line));
        assert!(said.starts_with("line 3: "), "{line} said {said}");
        assert!(said.contains(what) && said.contains(advice), "{line} said {said}");
    }
    let long = format!("\"title\": \"{}\",", "a".repeat(301));
    assert!(refused(&entry(&long)).contains("shorten it"));
    assert!(parse(&entry(&long.replacen('a', "", 1))).is_ok());
}

#[test]
fn what_an_entry_lacks_is_told_where_it_is() {
    let said = refused("{ \"scenes\": [\n  { \"scene\": \"a.glb\"\n  }\n] }");
    assert!(
        said.starts_with("line 3: ") && said.contains("may_be_shown"),
        "{said}"
    );
    // The second entry begins in the third line; brackets in texts are no brackets.
    let second = |rest: &str| {
        refused(&format!(
            "{{ \"scenes\": [\n  {{ \"scene\": \"[\\\"{{\", \"may_be_shown\": false }},\n  {{ {rest} }}\n] }}"
        ))
    };
    let said = second("\"scene\": \"a.glb\",\n\"author\": \"A\",\n\"may_be_shown\": true");
    assert!(
        said.starts_with("line 3: ") && said.contains("`licence`"),
        "{said}"
    );
    let said = second("\"scene\": \"stage\",\n\"may_be_shown\": true,\n\"environment_scale\": 2");
    assert!(
        said.starts_with("line 3: ") && said.contains("without an `environment`"),
        "{said}"
    );
    assert!(refused("{ \"scenes\": [] }").contains("is empty"));
    assert!(refused("{ \"scenes\": [").contains("line 1: "));
}

#[test]
fn paths_are_those_from_the_folder_of_the_list() {
    let folder = std::env::temp_dir().join(format!("lightbvh-list-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    let file = folder.join("list.json");
    let text = r#"{ "scenes": [ { "scene": "stage", "may_be_shown": true },
        { "scene": "b/c.glb", "environment": "d.hdr", "may_be_shown": false } ] }"#;
    fs::write(&file, text).expect("a file");
    let entries = read(&file).expect("a list");
    assert_eq!(entries[0].scene, "stage");
    assert_eq!(Path::new(&entries[1].scene), folder.join("b/c.glb"));
    assert_eq!(
        entries[1].environment.as_deref().map(Path::new),
        Some(&*folder.join("d.hdr"))
    );
    let _ = fs::remove_dir_all(&folder);
    let said = read(&file).expect_err("it is gone").to_string();
    assert!(
        said.contains("list.json") && said.contains("check that the file is there"),
        "{said}"
    );
}
