//! Shapes of control flow and of data that break drivers.

use lightbvh_kernels_builder::decorate::decorate;
use rspirv::dr::{Function, Operand};
use rspirv::spirv::{LoopControl, Op, SelectionControl};

use std::collections::{HashMap, HashSet, VecDeque};

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

/// Visits of SwiftShader's search for a block that is not there, from the first block on: a block counts as seen when it is taken
/// from the queue. `reversed` turns the order of the ways out of a block.
fn visits(function: &Function, reversed: bool) -> usize {
    let mut outs = HashMap::new();
    for block in &function.blocks {
        let last = block.instructions.last().expect("a branch or an end");
        let skip = match last.class.opcode {
            Op::Branch => 0,
            Op::BranchConditional | Op::Switch => 1,
            _ => usize::MAX,
        };
        let id = |operand: &Operand| operand.id_ref_any();
        let mut targets: Vec<u32> = last.operands.iter().filter_map(id).skip(skip).collect();
        if reversed {
            targets.reverse();
        }
        outs.insert(block.label.as_ref().and_then(|own| own.result_id), targets);
    }
    let (mut seen, mut visits) = (HashSet::new(), 0);
    let first = function.blocks[0].label.as_ref();
    let mut queue = VecDeque::from([first.and_then(|own| own.result_id)]);
    while let Some(block) = queue.pop_front() {
        visits += 1;
        assert!(visits < 1 << 20, "the search does not end");
        queue.extend(
            outs[&block]
                .iter()
                .map(|&out| Some(out))
                .filter(|out| !seen.contains(out)),
        );
        seen.insert(block);
    }
    visits
}

/// As rust-gpu writes selections, the search takes exponential time.
#[test]
fn searches_visit_each_block_once() {
    for work in [false, true] {
        let words = decorate(&loop_of_selections(40, work)).unwrap();
        assert_eq!(complaint(&words), "");
        let again = decorate(&words).unwrap();
        assert_eq!(again, words, "decorating twice changes nothing");
        let module = rspirv::dr::load_words(&words).unwrap();
        let function = &module.functions[0];
        for reversed in [false, true] {
            assert_eq!(visits(function, reversed), function.blocks.len());
        }
        let labels: Vec<u32> = function
            .blocks
            .iter()
            .filter_map(|block| block.label.as_ref()?.result_id)
            .collect();
        for inst in function.blocks.iter().flat_map(|block| &block.instructions) {
            if let (Op::Phi | Op::Branch, Some(Operand::IdRef(block))) =
                (inst.class.opcode, inst.operands.last())
            {
                assert!(labels.contains(block), "{inst:?}");
            }
        }
    }
}

/// Searches in the committed modules are short: ways out of loops meet too, so some blocks are visited a few times.
#[test]
fn searches_of_shipped_modules_are_short() {
    for kernel in lightbvh_gpu::KERNELS {
        let module = rspirv::dr::load_words(kernel.words()).unwrap();
        for function in &module.functions {
            for reversed in [false, true] {
                let (found, blocks) = (visits(function, reversed), function.blocks.len());
                assert!(found <= 16 * blocks, "{}: {found} of {blocks}", kernel.name);
            }
        }
    }
}
