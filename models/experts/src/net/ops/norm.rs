//! Layer norm over the last dimension.

use candle_core::{CpuStorage, CustomOp3, D, Layout, Result, Shape, Tensor};

use super::raw::{dot, floats, numbers, own_loops, sum, tensor};

const EPSILON: f32 = 1e-5;

/// Rows of `x` [.., n] with mean 0 and variance 1, times `scale` [n] plus `shift` [n].
///
/// # Errors
/// When the shapes do not fit.
pub fn layer_norm(x: &Tensor, scale: &Tensor, shift: &Tensor) -> Result<Tensor> {
    let x = x.contiguous()?;
    if own_loops(&x) {
        return x.apply_op3(scale, shift, LayerNorm);
    }
    let centred = x.broadcast_sub(&x.mean_keepdim(D::Minus1)?)?;
    let spread = (centred.sqr()?.mean_keepdim(D::Minus1)? + f64::from(EPSILON))?.sqrt()?;
    centred.broadcast_div(&spread)?.broadcast_mul(scale)?.broadcast_add(shift)
}

/// Mean and reciprocal deviation of a row.
fn moments(row: &[f32]) -> (f32, f32) {
    let mean = sum(row) / row.len() as f32;
    let mut lanes = [0.0f32; 8];
    let chunks = row.chunks_exact(8);
    let mut square: f32 = chunks.remainder().iter().map(|v| (v - mean) * (v - mean)).sum();
    for chunk in chunks {
        for lane in 0..8 {
            lanes[lane] += (chunk[lane] - mean) * (chunk[lane] - mean);
        }
    }
    square += sum(&lanes);
    (mean, 1.0 / (square / row.len() as f32 + EPSILON).sqrt())
}

struct LayerNorm;

impl CustomOp3 for LayerNorm {
    fn name(&self) -> &'static str {
        "layer-norm"
    }

    fn cpu_fwd(
        &self,
        x: &CpuStorage,
        x_layout: &Layout,
        scale: &CpuStorage,
        scale_layout: &Layout,
        shift: &CpuStorage,
        shift_layout: &Layout,
    ) -> Result<(CpuStorage, Shape)> {
        let (x, scale, shift) =
            (floats(x, x_layout)?, floats(scale, scale_layout)?, floats(shift, shift_layout)?);
        let mut y = vec![0.0; x.len()];
        for (row, out) in x.chunks_exact(scale.len()).zip(y.chunks_exact_mut(scale.len())) {
            let (mean, factor) = moments(row);
            for i in 0..out.len() {
                out[i] = (row[i] - mean) * factor * scale[i] + shift[i];
            }
        }
        Ok((CpuStorage::F32(y), x_layout.shape().clone()))
    }

    fn bwd(
        &self,
        x: &Tensor,
        scale: &Tensor,
        shift: &Tensor,
        _y: &Tensor,
        grad: &Tensor,
    ) -> Result<(Option<Tensor>, Option<Tensor>, Option<Tensor>)> {
        let grad = grad.contiguous()?;
        let (xs, gs, ss) = (x.storage_and_layout(), grad.storage_and_layout(), scale.storage_and_layout());
        let (xs, gs, ss) = (numbers(&xs)?, numbers(&gs)?, numbers(&ss)?);
        let n = ss.len();
        let mut x_grad = vec![0.0; xs.len()];
        let (mut scale_grad, mut shift_grad) = (vec![0.0; n], vec![0.0; n]);
        let (mut unit, mut pulled) = (vec![0.0; n], vec![0.0; n]);
        for ((row, grad), out) in xs.chunks_exact(n).zip(gs.chunks_exact(n)).zip(x_grad.chunks_exact_mut(n)) {
            let (mean, factor) = moments(row);
            for i in 0..n {
                unit[i] = (row[i] - mean) * factor;
                pulled[i] = grad[i] * ss[i];
                scale_grad[i] += grad[i] * unit[i];
                shift_grad[i] += grad[i];
            }
            let (level, tilt) = (sum(&pulled) / n as f32, dot(&pulled, &unit) / n as f32);
            for i in 0..n {
                out[i] = factor * (pulled[i] - level - unit[i] * tilt);
            }
        }
        Ok((Some(tensor(x_grad, x)?), Some(tensor(scale_grad, scale)?), Some(tensor(shift_grad, shift)?)))
    }
}

#[cfg(test)]
mod tests {
    use super::super::check::{compare, random};
    use super::layer_norm;

    #[test]
    fn gradients_are_right() {
        let inputs = [random(&[3, 4, 11], 1), random(&[11], 2), random(&[11], 3)];
        compare(&inputs, |t| layer_norm(&t[0], &t[1], &t[2]));
    }
}
