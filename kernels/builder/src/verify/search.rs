//! How long `SwiftShader` searches for the back edges of loops ([`crate::branches`] says why that matters).

use super::Findings;
use crate::branches::{id_at, label};
use rspirv::dr::{Block, Function, Operand};
use rspirv::spirv::Op;
use std::collections::{HashMap, HashSet, VecDeque};

/// The greatest kernel of this project takes a fifth of this and is compiled in two seconds, most of them spent elsewhere.
/// Where rows of meeting points get longer, the number soon grows out of all bounds.
const MOST_VISITS: u32 = 1 << 22;

/// Refuses loops whose bodies take the search too long.
pub(super) fn searches(function: &Function, findings: &mut Findings) {
    let targets: HashMap<u32, Vec<u32>> = function
        .blocks
        .iter()
        .map(|block| (label(block), targets(block)))
        .collect();
    for block in &function.blocks {
        let merges = block.instructions.iter().rev().nth(1);
        let Some(merge) = merges.filter(|inst| inst.class.opcode == Op::LoopMerge) else {
            continue;
        };
        // It takes the targets in an order of its own; the search is short only if it is so in both.
        let ends = id_at(merge, 0).unwrap_or(0);
        if [false, true]
            .iter()
            .any(|&last_first| visits(&targets, label(block), ends, last_first) > MOST_VISITS)
        {
            findings.refuse(
                merge,
                "SwiftShader would walk too many paths through this loop's body to compile it",
                "write its longest rows of if and else as selections of values",
            );
        }
    }
}

/// Blocks that the search takes from its queue, until it has taken too many.
fn visits(targets: &HashMap<u32, Vec<u32>>, header: u32, merge: u32, last_first: bool) -> u32 {
    let mut seen = HashSet::from([merge]);
    let mut pending = VecDeque::from([header]);
    let mut visits = 0;
    while let Some(id) = pending.pop_front()
        && visits <= MOST_VISITS
    {
        visits += 1;
        let next = targets.get(&id).map_or(&[][..], Vec::as_slice);
        let unseen = |id: &&u32| !seen.contains(id);
        if last_first {
            pending.extend(next.iter().rev().filter(unseen));
        } else {
            pending.extend(next.iter().filter(unseen));
        }
        seen.insert(id);
    }
    visits
}

/// The blocks that a block may go on to, each once.
fn targets(block: &Block) -> Vec<u32> {
    let Some(last) = block.instructions.last() else {
        return Vec::new();
    };
    let skip = match last.class.opcode {
        Op::Branch => 0,
        Op::BranchConditional | Op::Switch => 1,
        _ => return Vec::new(),
    };
    let mut found = Vec::new();
    for operand in last.operands.iter().skip(skip) {
        if let Operand::IdRef(id) = operand
            && !found.contains(id)
        {
            found.push(*id);
        }
    }
    found
}
