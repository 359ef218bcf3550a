//! Access to the numbers of tensors as slices.

use std::ops::Deref;

use candle_core::{CpuStorage, DType, Device, Error, Layout, Result, Storage, Tensor};

/// The numbers of a contiguous storage.
pub(super) fn floats<'a>(storage: &'a CpuStorage, layout: &Layout) -> Result<&'a [f32]> {
    let (start, end) =
        layout.contiguous_offsets().ok_or_else(|| Error::Msg("a contiguous tensor is needed".into()))?;
    Ok(&storage.as_slice::<f32>()?[start..end])
}

/// The numbers of a contiguous tensor on the CPU, from [`Tensor::storage_and_layout`].
pub(super) fn numbers<'a, G: Deref<Target = Storage>>(guard: &'a (G, &Layout)) -> Result<&'a [f32]> {
    match &*guard.0 {
        Storage::Cpu(storage) => floats(storage, guard.1),
        _ => Err(Error::Msg("a tensor on the CPU is needed".into())),
    }
}

/// Whether our own loops support this tensor; otherwise, mainly on a GPU, stock operations are used.
pub(super) fn own_loops(tensor: &Tensor) -> bool {
    #[cfg(test)]
    if super::check::stock_forms_wanted() {
        return false;
    }
    tensor.device().is_cpu() && tensor.dtype() == DType::F32
}

/// A tensor of these numbers on the CPU.
pub(super) fn tensor(values: Vec<f32>, like: &Tensor) -> Result<Tensor> {
    Tensor::from_vec(values, like.shape(), &Device::Cpu)
}

/// Inner product in eight fixed lanes, so that it is fast and the order of the sum is fixed.
#[inline]
pub(super) fn dot(a: &[f32], b: &[f32]) -> f32 {
    let mut lanes = [0.0f32; 8];
    let (a8, b8) = (a.chunks_exact(8), b.chunks_exact(8));
    let tail: f32 = a8.remainder().iter().zip(b8.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in a8.zip(b8) {
        for lane in 0..8 {
            lanes[lane] += x[lane] * y[lane];
        }
    }
    fold(lanes) + tail
}

/// Sum in eight fixed lanes.
#[inline]
pub(super) fn sum(a: &[f32]) -> f32 {
    let mut lanes = [0.0f32; 8];
    let a8 = a.chunks_exact(8);
    let tail: f32 = a8.remainder().iter().sum();
    for x in a8 {
        for lane in 0..8 {
            lanes[lane] += x[lane];
        }
    }
    fold(lanes) + tail
}

/// `y += factor * x`.
#[inline]
pub(super) fn add_scaled(y: &mut [f32], factor: f32, x: &[f32]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += factor * x;
    }
}

fn fold(l: [f32; 8]) -> f32 {
    ((l[0] + l[4]) + (l[2] + l[6])) + ((l[1] + l[5]) + (l[3] + l[7]))
}
