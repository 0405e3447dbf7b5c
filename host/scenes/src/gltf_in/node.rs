//! Nodes of the file's default scene, parents before children; cameras and the background.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use gltf::json;

use super::super::error::SceneError;
use super::super::model::{Camera, Node, SceneData};
use super::super::transform::Transform;
use super::bend::columns;
use super::{BACKGROUND_EXTRA, Document, instancing};

/// Fills nodes, cameras and background; gives the place of each of the file's nodes, `None` where the scene does not
/// use it.
pub(super) fn read(document: &Document<'_>, data: &mut SceneData) -> Result<Vec<Option<u32>>, SceneError> {
    let nodes = &document.root.nodes;
    let parents = parents(document)?;
    let [roots, listed] = roots(document, &parents, data)?;
    let mut placing = Placing {
        document,
        parents: &parents,
        place: vec![None; nodes.len()],
        cameras: Vec::new(),
    };
    placing.tree(roots, data)?;
    // Some exporters list nodes that have a parent. Where the parent is in the scene they stay its children, else they are roots.
    for node in listed {
        let what = "is listed, but has a parent: it stays with it where that is in the scene";
        document.note(&format!("scene.nodes: node {node}"), what);
        placing.tree(vec![node], data)?;
    }
    let Placing {
        place, mut cameras, ..
    } = placing;
    // The file's first camera is the one to see from, wherever its node stands.
    cameras.sort_by_key(|&(index, _)| index);
    data.cameras = cameras.into_iter().map(|(_, camera)| camera).collect();
    Ok(place)
}

/// Nodes on their way into the scene.
struct Placing<'d, 'a> {
    document: &'d Document<'a>,
    parents: &'d [Option<usize>],
    /// Where each of the file's nodes went.
    place: Vec<Option<u32>>,
    /// With their index in the file.
    cameras: Vec<(usize, Camera)>,
}

impl Placing<'_, '_> {
    /// Places nodes and all below them that are not placed yet: lowest index first among those whose parent is placed, so that
    /// files that are in order keep their order.
    fn tree(&mut self, roots: Vec<usize>, data: &mut SceneData) -> Result<(), SceneError> {
        let mut ready: BinaryHeap<Reverse<usize>> = roots.into_iter().map(Reverse).collect();
        while let Some(Reverse(index)) = ready.pop() {
            if self.place[index].is_some() {
                continue;
            }
            self.place[index] = Some(data.nodes.len() as u32);
            let parent = self.parents[index].and_then(|parent| self.place[parent]);
            add(self.document, index, parent, data, &mut self.cameras)?;
            let children = self.document.root.nodes[index].children.iter().flatten();
            ready.extend(children.map(|child| Reverse(child.value())));
        }
        Ok(())
    }
}

/// The parent of each node; refuses nodes with two (glTF 2.0, section 3.5.1: node hierarchies are trees).
fn parents(document: &Document<'_>) -> Result<Vec<Option<usize>>, SceneError> {
    let nodes = &document.root.nodes;
    let mut parents: Vec<Option<usize>> = vec![None; nodes.len()];
    for (index, node) in nodes.iter().enumerate() {
        let element = format!("nodes[{index}].children");
        for &child in node.children.iter().flatten() {
            document.get(nodes, child, "node", &element)?;
            if let Some(other) = parents[child.value()].replace(index) {
                let problem = format!("node {} is also a child of node {other}", child.value());
                return Err(document.malformed(element, problem, "give each node one parent"));
            }
        }
    }
    Ok(parents)
}

/// Roots of the default scene, or all roots where the file has no scene; and children that it lists.
fn roots(
    document: &Document<'_>,
    parents: &[Option<usize>],
    data: &mut SceneData,
) -> Result<[Vec<usize>; 2], SceneError> {
    let scene = match document.root.scene {
        Some(index) => Some(document.get(&document.root.scenes, index, "scene", "scene")?),
        None => document.root.scenes.first(),
    };
    let Some(scene) = scene else {
        let roots = (0..parents.len()).filter(|&node| parents[node].is_none());
        return Ok([roots.collect(), Vec::new()]);
    };
    data.background = background(document, scene)?;
    let (mut roots, mut listed) = (Vec::new(), Vec::new());
    for &node in &scene.nodes {
        document.get(&document.root.nodes, node, "node", "scene.nodes")?;
        let list = if parents[node.value()].is_some() {
            &mut listed
        } else {
            &mut roots
        };
        list.push(node.value());
    }
    Ok([roots, listed])
}

/// Appends a node; its camera goes to `cameras`, with the camera's index in the file.
fn add(
    document: &Document<'_>,
    index: usize,
    parent: Option<u32>,
    data: &mut SceneData,
    cameras: &mut Vec<(usize, Camera)>,
) -> Result<(), SceneError> {
    let node = &document.root.nodes[index];
    let element = format!("nodes[{index}]");
    if let Some(mesh) = node.mesh {
        document.get(&document.root.meshes, mesh, "mesh", &element)?;
    }
    if let Some(skin) = node.skin {
        document.get(&document.root.skins, skin, "skin", &element)?;
    }
    let mesh = node.mesh.map(|mesh| mesh.value() as u32);
    let skin = node.skin.map(|skin| skin.value() as u32);
    // A node's own weights come before its mesh's.
    let of_mesh = mesh.and_then(|mesh| document.root.meshes[mesh as usize].weights.clone());
    let weights = node.weights.clone().or(of_mesh).unwrap_or_default();
    if let Some(index) = node.camera {
        let camera = document.get(&document.root.cameras, index, "camera", &element)?;
        let index = index.value();
        match &camera.perspective {
            Some(perspective) => {
                let place = Camera {
                    node: data.nodes.len() as u32,
                    yfov: perspective.yfov,
                };
                cameras.push((index, place));
            }
            None => document.note(&element, "its camera is not perspective and is ignored"),
        }
    }
    let name = node.name.clone().unwrap_or_else(|| format!("node {index}"));
    let own = data.nodes.len() as u32;
    let instances = match mesh {
        Some(_) => instancing::places(document, node, &element)?,
        None => None,
    };
    data.nodes.push(Node {
        name: name.clone(),
        parent,
        transform: transform(node),
        mesh: mesh.filter(|_| instances.is_none()),
        skin,
        weights: weights.clone(),
    });
    for (i, transform) in instances.into_iter().flatten().enumerate() {
        data.nodes.push(Node {
            name: format!("{name} {i}"),
            parent: Some(own),
            transform,
            mesh,
            skin: None,
            weights: weights.clone(),
        });
    }
    Ok(())
}

fn transform(node: &json::Node) -> Transform {
    match &node.matrix {
        Some(matrix) => Transform::Matrix(columns(matrix)),
        None => Transform::Trs {
            translation: node.translation.unwrap_or_default(),
            rotation: node.rotation.unwrap_or_default().0,
            scale: node.scale.unwrap_or([1.0; 3]),
        },
    }
}

/// From the scene's extras; black where there is none.
fn background(document: &Document<'_>, scene: &json::Scene) -> Result<[f32; 3], SceneError> {
    let Some(extras) = &scene.extras else {
        return Ok([0.0; 3]);
    };
    let value: serde_json::Value = serde_json::from_str(extras.get()).unwrap_or_default();
    let Some(background) = value.get(BACKGROUND_EXTRA) else {
        return Ok([0.0; 3]);
    };
    serde_json::from_value(background.clone()).map_err(|error| {
        let element = format!("scene.extras.{BACKGROUND_EXTRA}");
        document.malformed(element, error.to_string(), "write three numbers")
    })
}
