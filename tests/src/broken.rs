//! Kernels made wrong on purpose: what a device would run that does not keep the rules, made of the committed SPIR-V.
//!
//! A device that contracts, re-associates or rounds otherwise is not at hand, so its arithmetic is written out in operations
//! that this one does keep: a fused product and sum from the product's own error (T. J. Dekker, "A floating-point technique for
//! extending the available precision", 1971), sums rounded towards zero from the sum's error (Knuth, The Art of Computer
//! Programming vol. 2, section 4.2.2, theorem B).

use std::collections::HashMap;

use rspirv::binary::Assemble;
use rspirv::dr::{Builder, Instruction, Module, Operand};
use rspirv::spirv::{Decoration, Op, Word};

/// What is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variant {
    /// No decoration `NoContraction`: the device may do as it likes.
    Undecorated,
    /// Each sum or difference with a product in it rounded once, by arithmetic: fused on every device.
    Contracted,
    /// `(a + b) + c` as `a + (b + c)`, and products likewise.
    Reassociated,
    /// Sums and differences rounded towards zero.
    Truncated,
    /// Results below 2^-126 are zero: what Vulkan allows.
    FlushedSubnormal,
    /// Results below 2^-30 are zero: what nothing allows.
    FlushedNormal,
}

/// The committed module `name` as `variant` has it.
///
/// # Panics
/// If there is no such module.
#[must_use]
pub fn module(name: &str, variant: Variant) -> Vec<u32> {
    let kernel = lightbvh_gpu::Kernel::named(name).unwrap_or_else(|| panic!("no kernel {name}"));
    let module = rspirv::dr::load_words(kernel.words()).expect("a module");
    let module = match variant {
        Variant::Undecorated => undecorated(module),
        _ => Rewriter::new(module).rewrite(variant),
    };
    module.assemble()
}

fn undecorated(mut module: Module) -> Module {
    let no_contraction = Operand::Decoration(Decoration::NoContraction);
    module
        .annotations
        .retain(|inst| !inst.operands.contains(&no_contraction));
    module
}

/// A type of float and the types and constants that go with it.
#[derive(Clone, Copy)]
struct Types {
    float: Word,
    uint: Word,
    boolean: Word,
    /// The number of components; 1 for a scalar.
    size: u32,
}

struct Rewriter {
    builder: Builder,
    /// By float type.
    types: HashMap<Word, Types>,
    /// New float operations.
    undecorated: Vec<Word>,
    /// The instructions of the block that is rewritten.
    out: Vec<Instruction>,
}

impl Rewriter {
    fn new(module: Module) -> Self {
        let mut builder = Builder::new_from_module(module);
        let (float, uint, boolean) = (
            builder.type_float(32, None),
            builder.type_int(32, 0),
            builder.type_bool(),
        );
        let mut types = HashMap::from([(
            float,
            Types {
                float,
                uint,
                boolean,
                size: 1,
            },
        )]);
        for size in 2..=4 {
            let vector = Types {
                float: builder.type_vector(float, size),
                uint: builder.type_vector(uint, size),
                boolean: builder.type_vector(boolean, size),
                size,
            };
            types.insert(vector.float, vector);
        }
        Self {
            builder,
            types,
            undecorated: Vec::new(),
            out: Vec::new(),
        }
    }

    fn rewrite(mut self, variant: Variant) -> Module {
        let mut functions = std::mem::take(&mut self.builder.module_mut().functions);
        for function in &mut functions {
            let made: HashMap<Word, Instruction> = function
                .all_inst_iter()
                .filter_map(|inst| Some((inst.result_id?, inst.clone())))
                .collect();
            for block in &mut function.blocks {
                for inst in std::mem::take(&mut block.instructions) {
                    self.one(inst, variant, &made);
                }
                block.instructions = std::mem::take(&mut self.out);
            }
        }
        for &id in &self.undecorated {
            self.builder.decorate(id, Decoration::NoContraction, []);
        }
        let mut module = self.builder.module();
        module.functions = functions;
        module
    }

    /// Writes `inst`, or what stands for it.
    fn one(&mut self, inst: Instruction, variant: Variant, made: &HashMap<Word, Instruction>) {
        let op = inst.class.opcode;
        let sum = matches!(op, Op::FAdd | Op::FSub);
        let types = inst.result_type.and_then(|ty| self.types.get(&ty)).copied();
        let (Some(types), Some(result), true) = (types, inst.result_id, sum || op == Op::FMul) else {
            return self.out.push(inst);
        };
        let operands = ids(&inst);
        match variant {
            Variant::Contracted if sum => {
                let factors = |k: usize| {
                    made.get(&operands[k])
                        .filter(|of| of.class.opcode == Op::FMul)
                        .map(ids)
                };
                let (mut factors, mut addend) = match (factors(0), factors(1)) {
                    (Some(of), _) => (of, operands[1]),
                    (None, Some(of)) => (of, operands[0]),
                    (None, None) => return self.out.push(inst),
                };
                if op == Op::FSub {
                    let negated = if addend == operands[1] {
                        &mut addend
                    } else {
                        &mut factors[0]
                    };
                    *negated = self.float(types, Op::FNegate, &[*negated]);
                }
                self.fused(types, factors[0], factors[1], addend, result);
            }
            Variant::Reassociated if op != Op::FSub => {
                // (x y) c as x (y c).
                match made
                    .get(&operands[0])
                    .filter(|inner| inner.class.opcode == op)
                    .map(ids)
                {
                    Some(inner) => {
                        let right = self.float(types, op, &[inner[1], operands[1]]);
                        self.put(types.float, op, &[inner[0], right], result);
                    }
                    None => self.out.push(inst),
                }
            }
            Variant::Truncated if sum => self.truncated(types, op, &operands, result),
            Variant::FlushedSubnormal => self.flushed(types, op, &operands, result, f32::MIN_POSITIVE),
            Variant::FlushedNormal => self.flushed(types, op, &operands, result, lightbvh::exact::pow2(-30)),
            _ => self.out.push(inst),
        }
    }

    /// a b + c, rounded nearly once; c + a b where the product's error is no number.
    fn fused(&mut self, types: Types, a: Word, b: Word, c: Word, result: Word) {
        let splitter = self.constant(types, 4097.0);
        let product = self.float(types, Op::FMul, &[a, b]);
        let mut halves = |x: Word| {
            let wide = self.float(types, Op::FMul, &[splitter, x]);
            let rest = self.float(types, Op::FSub, &[wide, x]);
            let high = self.float(types, Op::FSub, &[wide, rest]);
            (high, self.float(types, Op::FSub, &[x, high]))
        };
        let ((a_high, a_low), (b_high, b_low)) = (halves(a), halves(b));
        let high = self.float(types, Op::FMul, &[a_high, b_high]);
        let mut error = self.float(types, Op::FSub, &[high, product]);
        for (x, y) in [(a_high, b_low), (a_low, b_high), (a_low, b_low)] {
            let part = self.float(types, Op::FMul, &[x, y]);
            error = self.float(types, Op::FAdd, &[error, part]);
        }
        let (sum, sum_error) = self.sum(types, product, c);
        let both = self.float(types, Op::FAdd, &[sum_error, error]);
        let fused = self.float(types, Op::FAdd, &[sum, both]);
        let number = self.other(types.boolean, Op::FOrdEqual, &[fused, fused]);
        self.put(types.float, Op::Select, &[number, fused, sum], result);
    }

    /// The rounded sum and its error.
    fn sum(&mut self, types: Types, a: Word, b: Word) -> (Word, Word) {
        let sum = self.float(types, Op::FAdd, &[a, b]);
        let part = self.float(types, Op::FSub, &[sum, a]);
        let rest = self.float(types, Op::FSub, &[sum, part]);
        let (of_a, of_b) = (
            self.float(types, Op::FSub, &[a, rest]),
            self.float(types, Op::FSub, &[b, part]),
        );
        (sum, self.float(types, Op::FAdd, &[of_a, of_b]))
    }

    /// A sum that was rounded away from zero, where its error has the other sign, is taken back by a unit.
    fn truncated(&mut self, types: Types, op: Op, operands: &[Word], result: Word) {
        let second = if op == Op::FSub {
            self.float(types, Op::FNegate, &[operands[1]])
        } else {
            operands[1]
        };
        let (sum, error) = self.sum(types, operands[0], second);
        let (zero, one) = (self.constant(types, 0.0), self.integer(types, 31));
        let bits = self.other(types.uint, Op::Bitcast, &[sum]);
        let error_bits = self.other(types.uint, Op::Bitcast, &[error]);
        let signs = self.other(types.uint, Op::BitwiseXor, &[bits, error_bits]);
        let differ = self.other(types.uint, Op::ShiftRightLogical, &[signs, one]);
        let inexact = self.other(types.boolean, Op::FOrdNotEqual, &[error, zero]);
        let none = self.integer(types, 0);
        let back = self.other(types.uint, Op::Select, &[inexact, differ, none]);
        let moved = self.other(types.uint, Op::ISub, &[bits, back]);
        self.put(types.float, Op::Bitcast, &[moved], result);
    }

    fn flushed(&mut self, types: Types, op: Op, operands: &[Word], result: Word, least: f32) {
        let (zero, least) = (self.constant(types, 0.0), self.integer(types, least.to_bits()));
        let mask = self.integer(types, 0x7fff_ffff);
        let kept = self.float(types, op, operands);
        let bits = self.other(types.uint, Op::Bitcast, &[kept]);
        let magnitude = self.other(types.uint, Op::BitwiseAnd, &[bits, mask]);
        let small = self.other(types.boolean, Op::ULessThan, &[magnitude, least]);
        self.put(types.float, Op::Select, &[small, zero, kept], result);
    }

    fn constant(&mut self, types: Types, value: f32) -> Word {
        let scalar = self.builder.type_float(32, None);
        let one = self.builder.constant_bit32(scalar, value.to_bits());
        self.splat(types.float, types.size, one)
    }

    fn integer(&mut self, types: Types, value: u32) -> Word {
        let scalar = self.builder.type_int(32, 0);
        let one = self.builder.constant_bit32(scalar, value);
        self.splat(types.uint, types.size, one)
    }

    fn splat(&mut self, ty: Word, size: u32, one: Word) -> Word {
        match size {
            1 => one,
            _ => self.builder.constant_composite(ty, (0..size).map(|_| one)),
        }
    }

    /// A new float operation, not to be contracted.
    fn float(&mut self, types: Types, op: Op, operands: &[Word]) -> Word {
        let id = self.other(types.float, op, operands);
        self.undecorated.push(id);
        id
    }

    fn other(&mut self, ty: Word, op: Op, operands: &[Word]) -> Word {
        let id = self.builder.id();
        self.put(ty, op, operands, id);
        id
    }

    fn put(&mut self, ty: Word, op: Op, operands: &[Word], result: Word) {
        let operands = operands.iter().map(|&id| Operand::IdRef(id)).collect();
        self.out
            .push(Instruction::new(op, Some(ty), Some(result), operands));
    }
}

fn ids(inst: &Instruction) -> Vec<Word> {
    let id = |operand: &Operand| match operand {
        Operand::IdRef(id) => Some(*id),
        _ => None,
    };
    inst.operands.iter().filter_map(id).collect()
}
