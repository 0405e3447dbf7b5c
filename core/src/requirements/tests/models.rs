//! The model for what is found and declared, against the rules written out once more.

use std::string::ToString;
use std::vec::Vec;

use super::super::{Changes, Declared, Layout, Model, ModelError, Requirements, Structure, Updates};
use super::{below, lights, mesh};
use crate::bvh::LightBvh;
use crate::kit::Random;
use crate::{Edit, Transform};

fn declared(random: &mut Random) -> Declared {
    let mut coin = || below(random, 3) == 0;
    Declared {
        changes: Changes {
            transforms: coin(),
            radiance: coin(),
            triangles: coin(),
            instances: coin(),
            meshes: coin(),
        },
        glossy: coin(),
        pmf: coin(),
    }
}

#[test]
fn models_are_sufficient_and_no_larger() {
    let mut differ = [0; 6];
    let mut kept_for_later = 0;
    for seed in 0..2000 {
        let random = &mut Random(seed * 31);
        let (meshes, two_sided) = (1 + below(random, 2), [0, 8][below(random, 2) as usize]);
        let declared = declared(random);
        let found = Requirements::of(&lights(random, meshes, two_sided), declared);
        let model = found.model();
        assert_eq!(model.check(&found), Ok(()));
        assert!(!found.reasons().is_empty());
        let c = declared.changes;
        let absent = found.two_sided + found.dark == found.triangles;
        // One without flux may get some with its triangles, and with it a normal.
        let may_shine = c.triangles && found.unlit > 0;
        assert_eq!(
            model.layout == Layout::TwoSidedMoments,
            absent && !c.meshes && !may_shine
        );
        kept_for_later += usize::from(absent && may_shine && !c.meshes);
        let expected = match (c.triangles || c.meshes, c != Changes::NONE) {
            (true, _) => Updates::Meshes,
            (false, true) => Updates::Instances,
            (false, false) => Updates::Nothing,
        };
        assert_eq!(model.updates, expected);
        let stay = !(c.transforms || c.radiance || c.instances || c.meshes);
        let single = stay && (meshes == 1 || !c.triangles);
        assert_eq!(model.structure == Structure::SingleLevel, single);
        assert_eq!(
            (model.trails, model.uniform_halvings > 0),
            (declared.pmf, declared.pmf)
        );
        // Whatever else there is, it is refused or larger.
        let smaller = [
            Model {
                trails: false,
                ..model
            },
            Model {
                trails: false,
                uniform_halvings: 0,
                ..model
            },
            Model {
                updates: Updates::Nothing,
                ..model
            },
            Model {
                updates: model.updates.min(Updates::Instances),
                ..model
            },
            Model {
                structure: Structure::SingleLevel,
                ..model
            },
        ];
        for (k, smaller) in smaller.into_iter().enumerate() {
            assert_eq!(smaller.check(&found).is_ok(), smaller == model, "{smaller:?}");
            differ[k] += usize::from(smaller != model);
        }
        differ[5] += usize::from(model == Model::DEFAULT);
    }
    assert!(
        differ.iter().all(|&count| count > 20) && kept_for_later > 5,
        "{differ:?}, {kept_for_later}"
    );
}

#[test]
fn shared_meshes_keep_their_top_level() {
    let mut bvh = LightBvh::default();
    let own = bvh
        .add_mesh(mesh(&mut Random(3), 4, 0))
        .expect("within the domain");
    let add = |x: f32| Edit::AddInstance {
        mesh: own,
        transform: Transform::at([x, 0.0, 0.0]),
        radiance: 1.0,
    };
    bvh.apply([add(0.0)].into()).expect("an instance");
    let of = |bvh: &LightBvh| Requirements::of(bvh, Declared::STATIC).model().structure;
    assert_eq!(of(&bvh), Structure::SingleLevel);
    bvh.apply([add(1.0)].into()).expect("an instance");
    assert_eq!(of(&bvh), Structure::TwoLevel);
}

#[test]
fn what_does_not_fit_is_refused_in_words() {
    let found = Requirements::of(&lights(&mut Random(4), 1, 0), Declared::ANYTHING);
    let default = Model::DEFAULT;
    let refused: Vec<_> = [
        Model {
            trails: false,
            ..default
        },
        Model {
            trails: false,
            uniform_halvings: 0,
            ..default
        },
        Model {
            updates: Updates::Nothing,
            ..default
        },
        Model {
            structure: Structure::SingleLevel,
            ..default
        },
    ]
    .map(|model| model.check(&found).expect_err("too small"))
    .into();
    assert_eq!(
        refused,
        [
            ModelError::UniformWithoutTrails,
            ModelError::PmfWithoutTrails,
            ModelError::Updates(Updates::Meshes),
            ModelError::SingleLevel
        ]
    );
    // What is wrong, and what to do.
    assert!(refused.iter().all(|error| error.to_string().contains(';')));
    assert_eq!(
        default.to_string(),
        "Bvh<MomentNode<8>, Defensive<Moments, 6>, 8>, two levels"
    );
    let least = Model {
        layout: Layout::TwoSidedMoments,
        structure: Structure::SingleLevel,
        uniform_halvings: 0,
        trails: false,
        updates: Updates::Nothing,
        ..default
    };
    assert_eq!(
        least.type_name(),
        "StaticBvh<TwoSidedMomentNode<8>, Moments, 8, NoTrails>"
    );
}
