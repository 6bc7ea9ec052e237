//! Imports run one way: no circle between the crate's modules, nor between the stages of the damper.
//!
//! A module of the crate, and a module of the damper, counts as one with the files in its folder. What a file
//! declares or passes on (`mod`, `pub use`) is no import; unit tests may use what they like.

#![allow(clippy::unwrap_used)]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

type Graph = BTreeMap<String, BTreeSet<String>>;

/// All `.rs` files below a folder but those of unit tests, as their modules' paths.
fn files(folder: &Path, module: &[String], found: &mut Vec<(Vec<String>, String)>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let mut module = module.to_vec();
        module.push(path.file_stem().unwrap().to_str().unwrap().to_owned());
        if path.ends_with("tests.rs") {
            continue;
        }
        if path.is_dir() {
            files(&path, &module, found);
        } else {
            found.push((module, fs::read_to_string(&path).unwrap()));
        }
    }
}

/// The code of a file without comments, its unit tests, and modules that are for tests alone.
fn code(text: &str) -> String {
    let text = text.split("#[cfg(test)]\nmod tests").next().unwrap();
    let lines = text.lines().map(|line| line.split("//").next().unwrap());
    lines.collect::<Vec<_>>().join(" ")
}

/// The paths that a `use` names, braces resolved.
fn paths(tree: &str) -> Vec<String> {
    let tree = tree.trim();
    let Some((prefix, rest)) = tree.split_once('{') else {
        return vec![tree.to_owned()];
    };
    let (mut depth, mut parts) = (0, vec![String::new()]);
    for letter in rest.trim_end().trim_end_matches('}').chars() {
        depth += i32::from(letter == '{') - i32::from(letter == '}');
        if letter == ',' && depth == 0 {
            parts.push(String::new());
        } else {
            parts.last_mut().unwrap().push(letter);
        }
    }
    let named = parts.iter().filter(|part| !part.trim().is_empty());
    let whole = |path: String| format!("{}{path}", prefix.trim());
    named.flat_map(|part| paths(part)).map(whole).collect()
}

/// The path that a module with these `children` means by `path`, from the crate's root on; none if it is
/// another crate's.
fn absolute(module: &[String], children: &[String], path: &str) -> Option<Vec<String>> {
    let mut base = module.to_vec();
    let mut rest: Vec<&str> = path.split("::").map(str::trim).collect();
    match rest[0] {
        "crate" => base.clear(),
        "super" => {}
        child if children.iter().any(|own| own == child) => {}
        _ => return None,
    }
    while rest[0] == "super" {
        base.pop();
        rest.remove(0);
    }
    let rest = rest.iter().filter(|part| **part != "crate");
    Some(
        base.into_iter()
            .chain(rest.map(|part| (*part).to_owned()))
            .collect(),
    )
}

/// What counts as one module: of the damper's those below it, else those of the crate.
fn node(path: &[String]) -> Option<String> {
    let small = |part: &&String| part.starts_with(char::is_lowercase);
    let modules: Vec<&String> = path.iter().take_while(small).collect();
    match modules.as_slice() {
        [] => None,
        [damper, stage, ..] if *damper == "damper" => Some(format!("damper::{stage}")),
        [module, ..] => Some((*module).clone()),
    }
}

/// The paths in `code`: those that a `use` names, and those of the crate that stand by themselves.
fn named_in(code: &str) -> Vec<String> {
    let mut named = Vec::new();
    for part in code.split(';').map(str::trim_start) {
        if let Some(tree) = part.strip_prefix("use ") {
            named.extend(paths(tree));
        } else if !part.starts_with("pub") || !part.contains(" use ") {
            // What a macro names is for where it is used.
            let starts = part.match_indices("crate::");
            for (at, _) in starts.filter(|(at, _)| !part[..*at].ends_with('$')) {
                let in_path = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
                named.push(part[at..].chars().take_while(|c| in_path(*c)).collect());
            }
        }
    }
    named
}

/// The modules that `code` declares.
fn children_in(code: &str) -> Vec<String> {
    let parts = code.split(';').map(str::trim_start);
    let declared = parts.filter_map(|part| part.split_once("mod "));
    declared.map(|(_, child)| child.trim().to_owned()).collect()
}

fn imports() -> Graph {
    let mut found = Vec::new();
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    files(&source, &[], &mut found);
    let mut graph = Graph::new();
    for (module, text) in found {
        // The crate's root passes on; collisions are for the laws' tests.
        if module == ["lib"] || module == ["law", "collision"] {
            continue;
        }
        let own = node(&module).unwrap();
        let code = code(&text);
        let (named, children) = (named_in(&code), children_in(&code));
        let targets = named
            .iter()
            .filter_map(|path| node(&absolute(&module, &children, path)?));
        let targets: BTreeSet<_> = targets.filter(|target| *target != own).collect();
        graph.entry(own).or_default().extend(targets);
    }
    graph
}

/// A circle that a walk from `module` runs into.
fn circle(
    graph: &Graph,
    module: &str,
    walk: &mut Vec<String>,
    done: &mut BTreeSet<String>,
) -> Option<Vec<String>> {
    if let Some(start) = walk.iter().position(|step| step == module) {
        return Some(walk[start..].to_vec());
    }
    if !done.insert(module.to_owned()) {
        return None;
    }
    walk.push(module.to_owned());
    let mut next = graph.get(module).into_iter().flatten();
    let found = next.find_map(|next| circle(graph, next, walk, done));
    walk.pop();
    found
}

#[test]
fn no_module_imports_what_imports_it() {
    let graph = imports();
    assert!(graph["damper::step"].contains("damper::engine"));
    let mut done = BTreeSet::new();
    for module in graph.keys() {
        assert_eq!(circle(&graph, module, &mut Vec::new(), &mut done), None);
    }
}

#[test]
fn no_part_knows_the_damper() {
    let graph = imports();
    for part in [
        "integrator",
        "observer",
        "law",
        "detector",
        "mount",
        "cavity",
        "excitation",
    ] {
        let known = graph[part]
            .iter()
            .find(|module| module.starts_with("damper"));
        assert_eq!(known, None, "{part}");
    }
}
