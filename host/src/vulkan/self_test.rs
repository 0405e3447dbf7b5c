//! Is a device's arithmetic the CPU's? The self-test kernel on both, compared word by word.

use super::device::Device;
use super::error::VulkanError;
use super::pass::Pass;
use glam::UVec3;
use lightbvh_gpu::self_test::CHECKS;
use lightbvh_kernels::self_test::{Operands, SelfTestPush, operands, self_test};
use serde::Serialize;
use std::fmt;

/// Operand triples of the test: enough for every defect to show many times, done in milliseconds.
const TRIPLES: u32 = 16_384;

/// The verdict on a device.
#[derive(Clone, Debug, Serialize)]
pub struct Exactness {
    /// Whether the device computes the CPU's bits in all that counts.
    pub exact: bool,
    /// Answers compared.
    pub compared: u64,
    /// What it does wrong; empty if and only if it is exact.
    pub defects: Vec<Finding>,
    /// Where it answers differently and may: denormals, signs of zero. Shared code does not depend on these.
    pub freedoms: Vec<Finding>,
}

/// A check with differing answers.
#[derive(Clone, Debug, Serialize)]
pub struct Finding {
    /// Name of the check.
    pub check: &'static str,
    /// What a difference means, as it reads after "the device".
    pub says: &'static str,
    /// Number of differing answers.
    pub different: u64,
    /// Operands of the first, as float bits.
    pub operands: [u32; 3],
    /// The CPU's answer to them.
    pub cpu: u32,
    /// The device's answer.
    pub device: u32,
}

impl Device {
    /// Runs the self-test.
    pub fn self_test(&self) -> Result<Exactness, VulkanError> {
        let operands = operands(TRIPLES);
        let cpu = answers_of_cpu(&operands);
        let kernel = self.kernel("self_test")?;
        let input = self.upload(&operands)?;
        let output = self.output::<u32>(cpu.len())?;
        let push = SelfTestPush { count: TRIPLES };
        let mut pass = Pass::new();
        pass.dispatch(
            &kernel,
            &[input.bind(), output.bind()],
            bytemuck::bytes_of(&push),
            TRIPLES,
        );
        self.run(&pass)?;
        Ok(judge(&operands, &cpu, &output.read()?))
    }
}

/// What the same function answers as native code.
fn answers_of_cpu(operands: &[Operands]) -> Vec<u32> {
    let push = SelfTestPush {
        count: operands.len() as u32,
    };
    let mut answers = vec![0; operands.len() * CHECKS.len()];
    for i in 0..push.count {
        self_test(UVec3::new(i, 0, 0), &push, operands, &mut answers);
    }
    answers
}

/// Sorts the differing answers by check.
fn judge(operands: &[Operands], cpu: &[u32], device: &[u32]) -> Exactness {
    let mut findings: Vec<Option<Finding>> = vec![None; CHECKS.len()];
    let rows = cpu
        .chunks_exact(CHECKS.len())
        .zip(device.chunks_exact(CHECKS.len()));
    for (operands, (cpu, device)) in operands.iter().zip(rows) {
        for ((check, finding), (&cpu, &device)) in
            CHECKS.iter().zip(&mut findings).zip(cpu.iter().zip(device))
        {
            if cpu != device {
                let first = Finding {
                    check: check.name,
                    says: check.defect,
                    different: 0,
                    operands: [operands.a, operands.b, operands.c],
                    cpu,
                    device,
                };
                finding.get_or_insert(first).different += 1;
            }
        }
    }
    let (mut defects, mut freedoms) = (Vec::new(), Vec::new());
    for (check, finding) in CHECKS.iter().zip(findings) {
        let list = if check.counts { &mut defects } else { &mut freedoms };
        list.extend(finding);
    }
    Exactness {
        exact: defects.is_empty(),
        compared: cpu.len() as u64,
        defects,
        freedoms,
    }
}

impl fmt::Display for Exactness {
    /// `exact (...)` or `NOT exact: it ...`, each kind of defect once.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let says = |findings: &[Finding]| {
            let mut list: Vec<&str> = findings.iter().map(|finding| finding.says).collect();
            list.dedup();
            list.join("; ")
        };
        match (self.exact, self.freedoms.is_empty()) {
            (true, true) => write!(f, "exact"),
            (true, false) => write!(f, "exact ({})", says(&self.freedoms)),
            (false, _) => write!(f, "NOT exact: it {}", says(&self.defects)),
        }
    }
}
