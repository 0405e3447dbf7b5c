//! Checks of what bends: targets, influences, skins, and keys of weights; and of lights without area.

use super::super::analytic::{AnalyticKind, AnalyticLight};
use super::super::deform::{MorphChannel, is_skinned};
use super::super::error::SceneError;
use super::super::model::{Node, Primitive, SceneData};
use super::Check;

use lightbvh::light::{MAX_COORDINATE, MAX_RADIANCE};

impl Check<'_> {
    /// Targets and influences have an entry for each vertex, of numbers in range.
    pub(super) fn bends(&self, name: &str, primitive: &Primitive) -> Result<(), SceneError> {
        let vertices = primitive.positions.len();
        for (t, target) in primitive.targets.iter().enumerate() {
            if !target.is_empty() {
                self.length(|| format!("target {t} of {name}"), target.len(), vertices)?;
            }
            self.finite(|| format!("target {t} of {name}"), target.as_flattened())?;
            if let Some(&value) = target.as_flattened().iter().find(|x| x.abs() > MAX_COORDINATE) {
                return Err(self.out_of_range(format!("target {t} of {name}"), value, "within 2^40 metres"));
            }
        }
        for set in &primitive.influences {
            self.length(|| format!("influences of {name}"), set.len(), vertices)?;
            for influence in set {
                self.finite(|| format!("influences of {name}"), &influence.weights)?;
                if let Some(&value) = influence.weights.iter().find(|weight| **weight < 0.0) {
                    return Err(self.out_of_range(
                        format!("weight of a joint of {name}"),
                        value,
                        "at least 0",
                    ));
                }
            }
        }
        Ok(())
    }

    /// Skins name nodes, and have all the joints that the meshes on their nodes ask for.
    pub(super) fn skins(&self, data: &SceneData) -> Result<(), SceneError> {
        for (s, skin) in data.skins.iter().enumerate() {
            let binds = skin.inverse_bind.len();
            self.length(
                || format!("inverse bind matrices of skin {s}"),
                binds,
                skin.joints.len(),
            )?;
            for &joint in &skin.joints {
                self.index(|| format!("a joint of skin {s}"), joint, data.nodes.len())?;
            }
            let numbers = skin.inverse_bind.as_flattened().as_flattened();
            self.finite(|| format!("an inverse bind matrix of skin {s}"), numbers)?;
        }
        // The greatest joint of each mesh, found once however many nodes show it.
        let greatest = |primitive: &Primitive| {
            let all = primitive.influences.iter().flatten();
            all.flat_map(|influence| influence.joints).max()
        };
        let of_meshes: Vec<Option<u16>> = data
            .meshes
            .iter()
            .map(|mesh| mesh.primitives.iter().filter_map(greatest).max())
            .collect();
        for (n, node) in data.nodes.iter().enumerate() {
            self.finite(|| format!("a weight of node {n} `{}`", node.name), &node.weights)?;
            let Some(skin) = node.skin else { continue };
            self.index(
                || format!("skin of node {n} `{}`", node.name),
                skin,
                data.skins.len(),
            )?;
            let Some(mesh) = node.mesh else { continue };
            let skinned = |primitive: &Primitive| is_skinned(data, n, primitive);
            if let Some(joint) = of_meshes[mesh as usize]
                && data.meshes[mesh as usize].primitives.iter().any(skinned)
            {
                let joints = data.skins[skin as usize].joints.len();
                self.index(
                    || format!("a joint of the mesh of node {n} `{}`", node.name),
                    joint.into(),
                    joints,
                )?;
            }
        }
        Ok(())
    }

    pub(super) fn morph(
        &self,
        name: &str,
        channel: &MorphChannel,
        data: &SceneData,
    ) -> Result<(), SceneError> {
        self.index(|| format!("node of {name}"), channel.node, data.nodes.len())?;
        if channel.targets == 0 {
            return Err(self.out_of_range(format!("number of targets of {name}"), 0.0, "at least 1"));
        }
        let rows = self.keys(name, &channel.times, channel.interpolation)?;
        self.length(
            || format!("value list of {name}"),
            channel.values.len(),
            rows.saturating_mul(channel.targets as usize),
        )?;
        self.finite(|| format!("a value of {name}"), &channel.values)
    }

    pub(super) fn analytic(
        &self,
        index: usize,
        light: &AnalyticLight,
        nodes: &[Node],
    ) -> Result<(), SceneError> {
        let of_light = format!("of light {index} `{}`", light.name);
        self.index(|| format!("node {of_light}"), light.node, nodes.len())?;
        let node = &nodes[light.node as usize].name;
        let name = |what: &str| format!("{what} {of_light} on node {} `{node}`", light.node);
        self.color(|| name("colour"), light.color)?;
        self.finite(|| name("intensity"), &[light.intensity])?;
        if !(0.0..=MAX_RADIANCE).contains(&light.intensity) {
            let expected = "0 to 2^100; lower it, or leave the light out";
            return Err(self.out_of_range(name("intensity"), light.intensity, expected));
        }
        if let Some(range) = light.range
            && !(2.0_f32.powi(-20)..=MAX_COORDINATE).contains(&range)
        {
            return Err(self.out_of_range(name("range"), range, "2^-20 to 2^40 metres, or none"));
        }
        if let AnalyticKind::Spot { inner, outer } = light.kind
            && !(inner >= 0.0 && inner <= outer && outer > 0.0 && outer <= std::f32::consts::FRAC_PI_2)
        {
            let element = name("outer angle");
            return Err(self.out_of_range(
                element,
                outer,
                "radians above 0, not below the inner angle, up to pi / 2",
            ));
        }
        let sizes: &[f32] = match &light.kind {
            AnalyticKind::Sphere { radius } => std::slice::from_ref(radius),
            AnalyticKind::Rectangle { half } | AnalyticKind::Disc { half } => half,
            AnalyticKind::Box { half } => half,
            _ => &[],
        };
        if let Some(&size) = sizes.iter().find(|size| !(1e-9..=1e9).contains(*size)) {
            return Err(self.out_of_range(
                name("size"),
                size,
                "metres from 1e-9 to 1e9; leave the light out, or scale the scene",
            ));
        }
        self.color(
            || name("emission"),
            light.color.map(|channel| channel * light.intensity),
        )
    }
}
