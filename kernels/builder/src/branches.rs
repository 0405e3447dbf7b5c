//! The shape of branches: of the ways from a selection to where its arms meet, one is the shortest by two blocks.
//!
//! rust-gpu writes each selection as a diamond, two arms that meet. `SwiftShader` walks every path through a loop's body when it
//! looks for the loop's back edge: its search marks a block as seen when it is taken from the queue, not when it is put there
//! (`Function::ExistsPath` in its `SpirvShaderControlFlow.cpp`), so a block that two arms of equal length lead to is queued twice,
//! and so is all that follows. Thirty diamonds in a row are 2^30 visits: pipeline creation never ends, and takes all memory. Where
//! one arm is shorter by two blocks, the meeting block is seen before the other arm arrives, in whatever order blocks are queued.
//!
//! Empty blocks lengthen the other arms. Nothing that is computed changes.

use rspirv::dr::{Block, Function, Instruction, Module, Operand};
use rspirv::spirv::Op;
use std::collections::{HashMap, HashSet, VecDeque};

/// Leaves one shortest way through every selection in `module`.
pub(crate) fn uneven_arms(module: &mut Module) {
    let mut bound = module.header.as_ref().map_or(1, |header| header.bound);
    for function in &mut module.functions {
        // Inner selections first, for they lengthen the arms of outer ones. All that a header dominates stands behind it.
        for header in (0..function.blocks.len()).rev() {
            lengthen(function, header, &mut bound);
        }
    }
    if let Some(header) = &mut module.header {
        header.bound = bound;
    }
}

/// Lengthens arms of the selection that begins in block number `header`, if one does. `bound` is the next id.
fn lengthen(function: &mut Function, header: usize, bound: &mut u32) {
    let Some(merge) = merge_of(&function.blocks[header]) else {
        return;
    };
    let blocks = &function.blocks;
    let at: HashMap<u32, usize> = (0..).zip(blocks).map(|(at, block)| (label(block), at)).collect();
    let mut seen = HashSet::from([label(&blocks[header])]);
    let mut queue = VecDeque::from([(label(&blocks[header]), 0)]);
    // Those that lead to the meeting block, the nearest first, and how far they are.
    let mut ends: Vec<(u32, u32)> = Vec::new();
    while let Some((id, distance)) = queue.pop_front() {
        let targets = targets(&blocks[at[&id]]);
        if targets.contains(&merge) {
            ends.push((id, distance));
        }
        for target in targets {
            if target != merge && seen.insert(target) {
                queue.push_back((target, distance + 1));
            }
        }
    }
    let least = ends.first().map_or(0, |&(_, distance)| distance);
    for &(mut end, distance) in ends.iter().skip(1) {
        for _ in distance..least + 2 {
            insert(function, end, merge, *bound);
            end = *bound;
            *bound += 1;
        }
    }
}

/// Puts the empty block `between` after the block `end`, on its way to the block `merge`.
fn insert(function: &mut Function, end: u32, merge: u32, between: u32) {
    for block in &mut function.blocks {
        if label(block) == end {
            rename(block.instructions.last_mut(), merge, between);
        } else if label(block) == merge {
            let is_phi = |inst: &&mut Instruction| inst.class.opcode == Op::Phi;
            rename(block.instructions.iter_mut().take_while(is_phi), end, between);
        }
    }
    let branch = Instruction::new(Op::Branch, None, None, vec![Operand::IdRef(merge)]);
    let empty = Block {
        label: Some(Instruction::new(Op::Label, None, Some(between), Vec::new())),
        instructions: vec![branch],
    };
    let from = function.blocks.iter().position(|block| label(block) == end);
    function.blocks.insert(from.map_or(0, |from| from + 1), empty);
}

/// Where the arms of the selection at the end of a block meet.
fn merge_of(block: &Block) -> Option<u32> {
    match block.instructions.as_slice() {
        [.., merge, _] if merge.class.opcode == Op::SelectionMerge => ids(merge).first().copied(),
        _ => None,
    }
}

fn label(block: &Block) -> u32 {
    let label = block.label.as_ref();
    label.and_then(|label| label.result_id).unwrap_or(0)
}

fn ids(inst: &Instruction) -> Vec<u32> {
    let id = |operand: &Operand| match operand {
        Operand::IdRef(id) => Some(*id),
        _ => None,
    };
    inst.operands.iter().filter_map(id).collect()
}

/// The labels that the last instruction may go to. A label may occur twice.
fn targets(block: &Block) -> Vec<u32> {
    match block.instructions.last() {
        Some(last) if last.class.opcode == Op::Branch => ids(last),
        // Behind the condition.
        Some(last) if matches!(last.class.opcode, Op::BranchConditional | Op::Switch) => {
            ids(last).split_off(1)
        }
        _ => Vec::new(),
    }
}

/// Replaces the label `from` by `to`.
fn rename<'a>(insts: impl IntoIterator<Item = &'a mut Instruction>, from: u32, to: u32) {
    for operand in insts.into_iter().flat_map(|inst| &mut inst.operands) {
        if *operand == Operand::IdRef(from) {
            *operand = Operand::IdRef(to);
        }
    }
}
