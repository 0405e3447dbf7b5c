//! Nodes of the file's default scene, parents before children; cameras and the background.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use gltf::json;

use super::super::error::{SceneError, short};
use super::super::model::{Camera, Node, SceneData};
use super::super::transform::Transform;
use super::{BACKGROUND_EXTRA, Document};

/// Fills nodes, cameras and background; gives the place of each of the file's nodes, `None` where the scene does not
/// use it. Lowest index first among nodes whose parent is placed: files that are in order keep their order.
pub(super) fn read(document: &Document<'_>, data: &mut SceneData) -> Result<Vec<Option<u32>>, SceneError> {
    let nodes = &document.root.nodes;
    let parents = parents(document)?;
    let listed = listed(document, &parents, data)?;
    let children = |node: usize| nodes[node].children.iter().flatten().map(|child| child.value());
    let (mut used, mut next) = (vec![false; nodes.len()], listed.clone());
    while let Some(node) = next.pop() {
        if !std::mem::replace(&mut used[node], true) {
            next.extend(children(node));
        }
    }
    // Some exporters list nodes that have a parent. If the parent is in the scene they stay its children.
    let is_root = |node: &usize| parents[*node].is_none_or(|parent| !used[parent]);
    let roots = listed.iter().copied().filter(is_root);
    let mut ready: BinaryHeap<Reverse<usize>> = roots.map(Reverse).collect();
    let (mut place, mut cameras) = (vec![None; nodes.len()], Vec::new());
    while let Some(Reverse(node)) = ready.pop() {
        if place[node].is_none() {
            place[node] = Some(data.nodes.len() as u32);
            let parent = parents[node].and_then(|parent| place[parent]);
            add(document, node, parent, data, &mut cameras)?;
            ready.extend(children(node).map(Reverse));
        }
    }
    if let Some(node) = listed.iter().find(|&&node| place[node].is_none()) {
        let problem = format!("node {node} is below itself");
        return Err(document.malformed("scene.nodes", problem, "give each node one parent"));
    }
    // The file's first camera is the one to see from, wherever its node stands.
    cameras.sort_by_key(|&(index, _)| index);
    data.cameras = cameras.into_iter().map(|(_, camera)| camera).collect();
    Ok(place)
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

/// The nodes that the default scene lists, or all without a parent where the file has no scene.
fn listed(
    document: &Document<'_>,
    parents: &[Option<usize>],
    data: &mut SceneData,
) -> Result<Vec<usize>, SceneError> {
    let scene = match document.root.scene {
        Some(index) => Some(document.get(&document.root.scenes, index, "scene", "scene")?),
        None => document.root.scenes.first(),
    };
    let Some(scene) = scene else {
        return Ok((0..parents.len())
            .filter(|&node| parents[node].is_none())
            .collect());
    };
    data.background = background(document, scene)?;
    let check = |&node| document.get(&document.root.nodes, node, "node", "scene.nodes");
    scene.nodes.iter().try_for_each(|node| check(node).map(|_| ()))?;
    Ok(scene.nodes.iter().map(|node| node.value()).collect())
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
    if node.skin.is_some() {
        document.note(
            &element,
            "its skin is left out, and its mesh stands as it is modelled",
        );
    }
    let mesh = node.mesh.map(|mesh| mesh.value() as u32);
    if let Some(index) = node.camera {
        let camera = document.get(&document.root.cameras, index, "camera", &element)?;
        let node = data.nodes.len() as u32;
        match camera.perspective.as_ref().map(|own| own.yfov) {
            Some(yfov) => cameras.push((index.value(), Camera { node, yfov })),
            None => document.note(&element, "its camera is not perspective and is ignored"),
        }
    }
    let name = node
        .name
        .as_deref()
        .map_or_else(|| format!("node {index}"), short);
    data.nodes.push(Node {
        name,
        parent,
        transform: transform(node),
        mesh,
    });
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

/// The columns of an affine matrix, whose last row is (0, 0, 0, 1) (glTF 2.0, section 3.5.3).
fn columns(m: &[f32; 16]) -> [[f32; 3]; 4] {
    [0, 4, 8, 12].map(|column| [m[column], m[column + 1], m[column + 2]])
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
