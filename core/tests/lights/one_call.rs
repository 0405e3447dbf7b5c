//! Samples with all that shading needs, and densities where rays meet lights.

use crate::kit::{Random, Wide, dot, minus, wide};
use lightbvh::bvh::{Cursor, EditReason};
use lightbvh::importance::{Transmissive, TransmissivePoint};
use lightbvh::light::{AnyLight, Light, LightPoint, PointLight, SphereLight};
use lightbvh::node::SpotMomentNode;
use lightbvh::{
    BuildParams, Bvh, Defensive, Edit, InstanceId, LightBvh, Lights, Moments, ShadingPoint, Transform,
};

type Tree = Bvh<(SpotMomentNode<8, AnyLight>, Defensive<Moments, 6>)>;

/// Four meshes of lights of every kind, each twice under maps that keep angles.
fn scene(random: &mut Random) -> Tree {
    let mut bvh = Tree::default();
    for _ in 0..4 {
        let own = (0..16).map(|k| random.light(k % 6)).collect();
        let mesh = bvh.add_mesh(own).expect("in the domain");
        for _ in 0..2 {
            let place = random.similarity(5.0, 1.0);
            bvh.add_instance(mesh, place).expect("in the domain");
        }
    }
    bvh.refit();
    bvh
}

/// pmf · density · d² / c in `f64`, as pbrt-v4 has it; zero where no ray meets the light, or it does not emit to there.
fn density(on: &LightPoint, normal: Wide, from: [f32; 3], pmf: f32) -> f64 {
    let d = minus(wide(on.p), wide(from));
    let cosine = -dot(d, normal) / length(d);
    let cosine = if on.flags & 1 != 0 { cosine.abs() } else { cosine };
    let has_area = on.flags & LightPoint::IS_POINT == 0;
    if has_area && cosine > 1.0e-6 {
        f64::from(pmf) * f64::from(on.density) * dot(d, d) / cosine
    } else {
        0.0
    }
}

fn length(v: Wide) -> f64 {
    dot(v, v).sqrt()
}

fn is_near(found: f32, expected: f64, part: f64) -> bool {
    (f64::from(found) - expected).abs() <= part * expected.abs() + 1.0e-7 * part
}

/// A light stays within the domain whichever edit takes it out, also together with others of its batch.
#[test]
fn every_edit_is_checked_with_those_before_it() {
    let limit = 1_099_511_627_776.0; // 2^40
    let light = |x: f32| {
        let (p, intensity) = ([x, 0.0, 0.0], [1.0; 3]);
        AnyLight::from(PointLight {
            p,
            intensity,
            range: 0.0,
            mesh: 0,
        })
    };
    let far = Transform::at([limit, 0.0, 0.0]);
    let mut bvh = Tree::default();
    let id = bvh.add_light(light(0.0)).expect("in the domain");
    let mesh = bvh.view().mesh_of(id).expect("a mesh of its own");
    let place = |transform| Edit::SetTransform {
        instance: id,
        transform,
    };
    let set = |x| Edit::SetLight {
        instance: id,
        light: light(x),
    };
    assert!(bvh.apply(vec![place(far), set(limit)]).is_err());
    bvh.set_transform(id, far).expect("in the domain");
    assert!(bvh.set_light(id, light(limit)).is_err());
    let add = |mesh, transform| Edit::AddInstance {
        mesh,
        transform,
        radiance: [1.0; 3],
        mask: u32::MAX,
    };
    // Another instance keeps the mesh.
    let other = bvh.add_instance(mesh, Transform::IDENTITY).expect("a mesh");
    let batch = vec![Edit::RemoveInstance(id), add(mesh, Transform::IDENTITY)];
    bvh.apply(batch).expect("the mesh is there");
    assert!(bvh.view().mesh_of(other).is_some());

    let mesh = bvh
        .add_mesh(vec![light(limit / 2.0), light(0.0)])
        .expect("in the domain");
    let lights = vec![light(limit), light(0.0)];
    assert!(
        bvh.apply(vec![add(mesh, far), Edit::SetLights { mesh, lights }])
            .is_err()
    );
    let id = bvh.add_instance(mesh, Transform::IDENTITY).expect("a mesh");
    let (first, lights) = (1, vec![light(1.0)]);
    let range = Edit::SetLightRange { mesh, first, lights };
    bvh.apply(vec![range]).expect("in the domain");
    assert!(
        bvh.set_transform(id, Transform::at([0.75 * limit, 0.0, 0.0]))
            .is_err()
    );
}

/// Numbers that are taken at once never run out, and nobody owns a removed light's sample.
#[test]
fn removed_lights_are_nobodys() {
    let mut bvh = Tree::default();
    let point = ShadingPoint {
        p: [0.0, 1.0, 0.0],
        n: [0.0; 3],
    };
    let light = PointLight {
        intensity: [1.0; 3],
        ..PointLight::DARK
    };
    bvh.add_light(light).expect("in the domain");
    for round in 0..140_000 {
        let id = bvh.add_light(light).expect("in the domain");
        if round == 0 {
            bvh.refit();
            let mut number = 0_u32;
            let found = loop {
                let found = bvh.sample(&point, number).expect("a light");
                if found.instance == id.index() {
                    break found;
                }
                number += 1 << 24;
            };
            bvh.remove(id).expect("a light");
            assert!(bvh.owner(&found).is_none());
            bvh.take_removed_lights();
            continue;
        }
        let numbers = bvh.view().lights_of(id).expect("a light");
        bvh.remove(id).expect("a light");
        assert_eq!(bvh.take_removed_lights(), [numbers]);
    }
}

/// Lamps at one place, such as a pool of unused ones, are inserted one by one: the top level is not built again.
#[test]
fn lights_at_one_place_are_inserted() {
    let random = &mut Random(5);
    let mut bvh = Tree::default();
    let at = |p: [f32; 3]| PointLight {
        p,
        ..PointLight::DARK
    };
    let add = |_| bvh.add_light(at(random.point(1000.0).p)).expect("in the domain");
    let ids: Vec<InstanceId> = (0..3000).map(add).collect();
    bvh.refit();
    let mut cursor = Cursor::default();
    let _ = cursor.plan(&bvh);
    for id in &ids[..300] {
        bvh.set_light(*id, at([0.0; 3])).expect("in the domain");
        bvh.refit();
        let plan = cursor.plan(&bvh);
        assert!(!plan.everything && !plan.whole_top);
    }
}

/// What lies behind a leaf lights its back.
#[test]
fn a_surface_with_two_sides_receives_on_both() {
    let mut bvh = Bvh::<(SpotMomentNode<8, AnyLight>, Transmissive<Moments>)>::default();
    let p = [0.0, -2.0, 0.0];
    let (radius, radiance) = (0.5, [1.0; 3]);
    bvh.add_light(SphereLight {
        p,
        radius,
        radiance,
        mesh: 0,
    })
    .expect("in the domain");
    bvh.refit();
    let [above, below] = [1.0, -1.0].map(|y| ShadingPoint {
        p: [0.0; 3],
        n: [0.0, y, 0.0],
    });
    let leaf = TransmissivePoint {
        point: above,
        front: 0.5,
        back: 0.5,
    };
    let sampled = bvh.sample_light(&leaf, 1_u32, [0.5; 2]).expect("the light");
    assert!(sampled.irradiance[0] > 0.0);
    assert_eq!(sampled.irradiance, sampled.point.irradiance(&below));
}

/// All numbers of a sample are those of its light, and the density of a ray that meets its point is that of the sample.
#[test]
fn a_sample_and_a_hit_agree_with_their_light() {
    let random = &mut Random(97);
    let bvh = scene(random);
    let (mut met, mut spheres) = (0, 0);
    for _ in 0..20_000 {
        let point = random.point(8.0);
        let uv = [random.unit(), random.unit()];
        let number = random.below(u32::MAX);
        let plain = bvh.sample(&point, number).expect("a light");
        let sampled = bvh.sample_light(&point, number, uv).expect("a light");
        let start = bvh.view().lights_of(sampled.instance).expect("an instance").start;
        assert_eq!(plain.light, start + sampled.part);
        assert_eq!(
            (plain.instance, plain.pmf),
            (sampled.instance.index(), sampled.pmf)
        );
        let owner = bvh.owner(&plain).expect("a light");
        let light = owner.light;
        assert_eq!(
            (owner.instance, owner.part, owner.light),
            (sampled.instance, sampled.part, sampled.light)
        );
        assert_eq!(bvh.view().mesh_of(owner.instance), Some(owner.mesh));
        assert_eq!(bvh.pmf(&point, owner.instance, owner.part), Some(sampled.pmf));
        let on = light.point_for(point.p.into(), uv);
        assert_eq!((sampled.point, sampled.irradiance), (on, on.irradiance(&point)));
        let d = minus(wide(on.p), wide(point.p));
        assert!(is_near(sampled.distance, length(d), 1.0e-5));
        for k in 0..3 {
            assert!((f64::from(sampled.direction[k]) - d[k] / length(d)).abs() < 1.0e-5);
        }
        let expected = density(&on, wide(on.normal), point.p, sampled.pmf);
        assert!(
            is_near(sampled.pdf, expected, 2.0e-3),
            "{} {expected}",
            sampled.pdf
        );
        let hit = bvh
            .pdf_of_hit(&point, sampled.instance, sampled.part, on.p)
            .expect("a light");
        // A sphere's normal is that of the place, whose digits are fewer than the radius's.
        let sphere = SphereLight::try_from(light);
        let normal = sphere.map_or(wide(on.normal), |own| {
            let n = minus(wide(on.p), wide(own.p));
            n.map(|x| x / length(n))
        });
        let expected = density(&on, normal, point.p, sampled.pmf);
        assert!(is_near(hit, expected, 2.0e-3), "{hit} {expected} {light:?}");
        met += u32::from(hit > 0.0);
        spheres += u32::from(sphere.is_ok() && hit > 0.0);
    }
    assert!(met > 3_000 && spheres > 500, "{met} {spheres}");
}

/// Single levels, scenes without light, unknown ids and receivers that are none.
#[test]
fn what_is_no_sample_is_none() {
    let random = &mut Random(3);
    let own: Vec<_> = (0..9).map(|k| random.light(k % 6)).collect();
    let bvh = Tree::single_level(&Lights::new(own).expect("in the domain"), &BuildParams::default());
    let point = ShadingPoint {
        p: [0.0; 3],
        n: [0.0, 1.0, 0.0],
    };
    let sampled = bvh.sample_light(&point, 5_u32, [0.5; 2]).expect("a light");
    let hit = |point: &ShadingPoint, part| bvh.pdf_of_hit(point, sampled.instance, part, sampled.point.p);
    assert!(hit(&point, sampled.part).is_some());
    assert_eq!(hit(&point, 9), None);
    assert_eq!(hit(&point, u32::MAX), None);
    let none = LightBvh::default();
    assert!(none.sample_light(&point, 5_u32, [0.5; 2]).is_none());
    assert!(none.pdf_of_hit(&point, sampled.instance, 0, [0.0; 3]).is_none());
    for (p, n) in [
        (point.p, [f32::NAN; 3]),
        (point.p, [0.0, 1.1, 0.0]),
        ([f32::NAN, 0.0, 0.0], point.n),
        ([f32::INFINITY, 0.0, 0.0], point.n),
    ] {
        let wrong = ShadingPoint { p, n };
        assert!(bvh.sample_light(&wrong, 5_u32, [0.5; 2]).is_none());
        assert_eq!(hit(&wrong, sampled.part), None);
    }
    for position in [[f32::NAN; 3], [f32::MAX; 3], point.p] {
        let found = bvh.pdf_of_hit(&point, sampled.instance, sampled.part, position);
        assert!(
            found.is_some_and(|pdf| (0.0..=f32::MAX).contains(&pdf)),
            "{found:?}"
        );
    }
}

/// Lights by themselves come, change, move and go as instances do, and leave nothing behind.
#[test]
fn lights_by_themselves() {
    let random = &mut Random(11);
    let mut bvh = Tree::default();
    let mut own: Vec<(InstanceId, AnyLight)> = Vec::new();
    let mesh = bvh.add_mesh(vec![random.light(2)]).expect("in the domain");
    let of_mesh = bvh.add_instance(mesh, Transform::IDENTITY).expect("a mesh");
    let mut most = 0;
    for round in 0..400_u32 {
        let kind = random.below(6);
        let light = random.light(kind);
        match random.below(4) {
            0 if !own.is_empty() => {
                let (id, _) = own.swap_remove(random.below(own.len() as u32) as usize);
                bvh.remove(id).expect("a light");
                assert_eq!(bvh.set_light(id, light), Err(EditReason::UnknownInstance(id)));
            }
            1 if !own.is_empty() => {
                let at = random.below(own.len() as u32) as usize;
                bvh.set_light(own[at].0, light).expect("a light");
                own[at].1 = light;
            }
            _ if own.len() < 40 => own.push((bvh.add_light(light).expect("in the domain"), light)),
            _ => {}
        }
        bvh.refit();
        bvh.take_removed_lights();
        bvh.view().validate().expect("nodes are what refit makes");
        for (id, light) in &own {
            let number = bvh.view().lights_of(*id).expect("a light").start;
            let light = light.checked().expect("in the domain");
            let expected = light.in_world(&bvh.view().instances()[id.index() as usize], id.index());
            assert_eq!(bvh.view().light(number, id.index()), Some(expected));
        }
        assert_eq!(bvh.view().light_count(), own.len() + 1);
        // Once there have been forty, all room is used again.
        if round == 300 {
            most = bvh.view().memory();
        }
    }
    assert!(bvh.view().memory() <= most + most / 8 && bvh.view().instances().len() <= 42);
    assert_eq!(
        bvh.set_light(of_mesh, random.light(1)),
        Err(EditReason::NoLight(of_mesh))
    );
    let words = bvh.to_words();
    let mut read = Tree::from_words(&words).expect("its words");
    let at = read.view().instance_id(own[0].0.index()).expect("a light");
    read.set_light(at, random.light(3)).expect("a light still");
    // In one batch: it is gone for what follows.
    let (id, light) = own[0];
    let mesh = bvh.view().mesh_of(id).expect("a mesh of its own");
    let edits = vec![
        Edit::RemoveInstance(id),
        Edit::AddInstance {
            mesh,
            transform: Transform::IDENTITY,
            radiance: [1.0; 3],
            mask: u32::MAX,
        },
    ];
    let error = bvh.apply(edits).expect_err("the mesh went with its light");
    assert_eq!((error.edit, error.reason), (1, EditReason::UnknownMesh(mesh)));
    bvh.apply(vec![Edit::AddLight { light, mask: 5 }, Edit::RemoveInstance(id)])
        .expect("both are there");
    let nan = SphereLight {
        radius: f32::NAN,
        ..SphereLight::DARK
    };
    assert!(matches!(bvh.add_light(nan), Err(EditReason::Alone(_))));
}
