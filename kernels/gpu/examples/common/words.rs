//! Comparison word by word.

use bytemuck::{Pod, pod_read_unaligned};

use super::Result;

/// Counts the words of `cpu`, which must be those at the start of `device`.
///
/// # Errors
/// Names the first element that differs, and both.
pub fn compare<T: Pod + std::fmt::Debug>(what: &str, cpu: &[T], device: &[u8]) -> Result<u64> {
    if device.len() < size_of_val(cpu) {
        return Err(format!(
            "{what}: {} bytes where {} are wanted",
            device.len(),
            size_of_val(cpu)
        )
        .into());
    }
    for (index, (cpu, device)) in cpu.iter().zip(device.chunks_exact(size_of::<T>())).enumerate() {
        // Bytes, not numbers: -0 is not 0, and a NaN is itself.
        if bytemuck::bytes_of(cpu) != device {
            let device: T = pod_read_unaligned(device);
            return Err(format!("{what} {index} differs\n  CPU    {cpu:?}\n  device {device:?}").into());
        }
    }
    Ok((size_of_val(cpu) / 4) as u64)
}
