//! Shapes of control flow and of data that break drivers.

use lightbvh_kernels_builder::decorate::decorate;
use rspirv::dr::Operand;
use rspirv::spirv::{LoopControl, Op, SelectionControl};

use super::module::{complaint, module};

/// A loop whose body is a row of `count` selections between two blocks; with `work`, each of the two computes something.
fn loop_of_selections(count: usize, work: bool) -> Vec<u32> {
    module(|b, t| {
        let boolean = b.type_bool();
        let yes = b.constant_true(boolean);
        let [header, first, next, end] = [(); 4].map(|()| b.id());
        b.branch(header).unwrap();
        b.begin_block(Some(header)).unwrap();
        b.loop_merge(end, next, LoopControl::NONE, []).unwrap();
        b.branch(first).unwrap();
        b.begin_block(Some(first)).unwrap();
        for _ in 0..count {
            let [left, right, meeting] = [(); 3].map(|()| b.id());
            b.selection_merge(meeting, SelectionControl::NONE).unwrap();
            b.branch_conditional(yes, left, right, []).unwrap();
            let mut values = Vec::new();
            for side in [left, right] {
                b.begin_block(Some(side)).unwrap();
                let value = if work || side == left {
                    b.f_add(t.float, None, t.two, t.three).unwrap()
                } else {
                    t.three
                };
                values.push((value, side));
                b.branch(meeting).unwrap();
            }
            b.begin_block(Some(meeting)).unwrap();
            b.phi(t.float, None, values).unwrap();
        }
        b.branch(next).unwrap();
        b.begin_block(Some(next)).unwrap();
        b.branch_conditional(yes, header, end, []).unwrap();
        b.begin_block(Some(end)).unwrap();
    })
}

/// Selections of two arms are what SwiftShader compiles in exponential time.
#[test]
fn selections_have_one_arm() {
    for work in [false, true] {
        let words = decorate(&loop_of_selections(40, work)).unwrap();
        assert_eq!(complaint(&words), "");
        assert_eq!(
            decorate(&words).unwrap(),
            words,
            "decorating twice changes nothing"
        );
        let module = rspirv::dr::load_words(&words).unwrap();
        let blocks = &module.functions[0].blocks;
        // The entry, the loop's header, first block, last block and end, and two for each arm.
        assert_eq!(blocks.len(), 5 + 2 * 40 * (1 + usize::from(work)));
        let labels: Vec<u32> = blocks
            .iter()
            .filter_map(|block| block.label.as_ref()?.result_id)
            .collect();
        for inst in blocks.iter().flat_map(|block| &block.instructions) {
            if let (Op::Phi | Op::Branch, Some(Operand::IdRef(block))) =
                (inst.class.opcode, inst.operands.last())
            {
                assert!(labels.contains(block), "{inst:?}");
            }
        }
        for block in blocks {
            if let [.., merge, branch] = &*block.instructions
                && merge.class.opcode == Op::SelectionMerge
            {
                assert!(branch.operands[1..3].contains(&merge.operands[0]), "{branch:?}");
            }
        }
    }
}
