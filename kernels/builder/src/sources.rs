//! The sources that shape the modules, and their hash.
//!
//! Files: those the compiler read (its dependency list), the manifests of the crates they belong to, and the parts of
//! this crate that choose options and rewrite modules. Of `Cargo.lock` and the workspace's `Cargo.toml` only what
//! concerns the kernels counts, so that a new dependency of the host needs no kernel compiler.

use crate::Error;
use crate::files::read;
use sha2::{Digest, Sha256};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Files that shape the modules although the compiler's dependency list does not name them.
pub const ALWAYS: [&str; 5] = [
    "core/Cargo.toml",
    "kernels/Cargo.toml",
    "kernels/builder/src/branches.rs",
    "kernels/builder/src/compile.rs",
    "kernels/builder/src/decorate.rs",
];

/// The crate of the entry points, as Cargo names it.
pub const KERNELS: &str = "lightbvh-kernels";

/// SHA-256, in hexadecimal, of the files' names and contents and of what the kernels depend on.
///
/// # Errors
/// Names the first file that cannot be read.
pub fn hash(root: &Path, files: &[String]) -> Result<String, Error> {
    let mut digest = Sha256::new();
    for file in files {
        feed(&mut digest, file, &read(&root.join(file))?);
    }
    let lock = text(&root.join("Cargo.lock"))?;
    let packages = dependencies(&lock);
    for (name, entry) in &packages {
        feed(&mut digest, name, entry.as_bytes());
    }
    for line in text(&root.join("Cargo.toml"))?.lines() {
        if line
            .split_once('=')
            .is_some_and(|(key, _)| packages.contains_key(key.trim()))
        {
            feed(&mut digest, "Cargo.toml", line.as_bytes());
        }
    }
    Ok(hex(&digest.finalize()))
}

/// SHA-256 of a file's bytes, in hexadecimal.
#[must_use]
pub fn hash_bytes(bytes: &[u8]) -> String {
    hex(&Sha256::digest(bytes))
}

/// Name, length and content, so that no two lists of files feed the same bytes.
fn feed(digest: &mut Sha256, name: &str, content: &[u8]) {
    for part in [name.as_bytes(), content] {
        digest.update((part.len() as u64).to_le_bytes());
        digest.update(part);
    }
}

fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

fn text(path: &Path) -> Result<String, Error> {
    read(path).map(|bytes| String::from_utf8_lossy(&bytes).into_owned())
}

/// What the kernels depend on according to `Cargo.lock`: for each package its entry there (version and checksum),
/// directly or through others. Several versions of one name are taken together.
fn dependencies(lock: &str) -> BTreeMap<String, String> {
    let mut entries: BTreeMap<&str, String> = BTreeMap::new();
    for entry in lock.split("[[package]]").skip(1) {
        let name = entry
            .lines()
            .find_map(|line| line.strip_prefix("name = "))
            .unwrap_or_default();
        entries
            .entry(name.trim_matches('"'))
            .or_default()
            .push_str(entry.trim());
    }
    let mut found = BTreeMap::new();
    let mut open = BTreeSet::from([KERNELS.to_owned()]);
    while let Some(name) = open.pop_first() {
        let Some(entry) = entries.get(name.as_str()) else {
            continue;
        };
        // Dependencies stand one to a line: ` "name",` or ` "name version",`.
        let needs = entry
            .lines()
            .filter_map(|line| line.trim_start().strip_prefix('"'));
        for need in needs.filter_map(|need| need.split(['"', ' ']).next()) {
            if !found.contains_key(need) && need != name {
                open.insert(need.to_owned());
            }
        }
        found.insert(name, entry.clone());
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOCK: &str = "version = 4\n\n[[package]]\nname = \"ash\"\nversion = \"1.0.0\"\n\n\
        [[package]]\nname = \"glam\"\nversion = \"2.0.0\"\nchecksum = \"ab\"\n\n\
        [[package]]\nname = \"lightbvh\"\nversion = \"0.1.0\"\ndependencies = [\n \"glam 2.0.0\",\n]\n\n\
        [[package]]\nname = \"lightbvh-kernels\"\nversion = \"0.1.0\"\ndependencies = [\n \"lightbvh\",\n]\n";

    #[test]
    fn only_what_the_kernels_reach_counts() {
        let found = dependencies(LOCK);
        assert_eq!(
            found.keys().collect::<Vec<_>>(),
            ["glam", "lightbvh", "lightbvh-kernels"]
        );
        assert!(found["glam"].contains("checksum = \"ab\""));
    }
}
