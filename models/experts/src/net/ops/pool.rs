//! Maximum over sets of tokens.

use candle_core::{CpuStorage, CustomOp2, Layout, Result, Shape, Tensor};

use super::raw::{floats, numbers, own_loops, tensor};

/// Mask value below which a token is padding.
const PADDING: f32 = -1e3;

/// Maximum over each segment of the tokens. `x` is [batch, tokens, n]; `mask` [batch, tokens] is 0 or, at
/// padding, -1e4; `segments` are lengths that sum to `tokens`. Returns [batch, segments * n]; a segment of
/// only padding gives 0. One of several tied tokens gets the gradient, on the CPU the first.
///
/// # Errors
/// When the shapes do not fit.
pub fn segment_max(x: &Tensor, mask: &Tensor, segments: &[usize]) -> Result<Tensor> {
    let x = x.contiguous()?;
    if own_loops(&x) {
        return x.apply_op2(&mask.contiguous()?, SegmentMax { segments: segments.to_vec() });
    }
    let (masked, mut start, mut parts) = (x.broadcast_add(&mask.unsqueeze(2)?)?, 0, Vec::new());
    for &length in segments {
        let any = mask.narrow(1, start, length)?.max_keepdim(1)?.ge(f64::from(PADDING))?;
        // Gathered, so that only one of several tied tokens gets the gradient; the maximum would give it to
        // each.
        let set = masked.narrow(1, start, length)?.contiguous()?;
        let best = set.gather(&set.argmax_keepdim(1)?, 1)?.squeeze(1)?;
        parts.push(best.broadcast_mul(&any.to_dtype(x.dtype())?)?);
        start += length;
    }
    Tensor::cat(&parts, 1)
}

struct SegmentMax {
    segments: Vec<usize>,
}

impl SegmentMax {
    /// Calls back with (batch, segment, first row, last row + 1), rows counted over the batch.
    fn each(&self, batches: usize, mut visit: impl FnMut(usize, usize, usize, usize)) {
        let tokens: usize = self.segments.iter().sum();
        for batch in 0..batches {
            let mut row = batch * tokens;
            for (segment, &length) in self.segments.iter().enumerate() {
                visit(batch, segment, row, row + length);
                row += length;
            }
        }
    }
}

impl CustomOp2 for SegmentMax {
    fn name(&self) -> &'static str {
        "segment-max"
    }

    fn cpu_fwd(
        &self,
        x: &CpuStorage,
        x_layout: &Layout,
        mask: &CpuStorage,
        mask_layout: &Layout,
    ) -> Result<(CpuStorage, Shape)> {
        let (batches, tokens, n) = x_layout.shape().dims3()?;
        if self.segments.iter().sum::<usize>() != tokens {
            candle_core::bail!("segments {:?} do not make {tokens} tokens", self.segments);
        }
        let (x, mask) = (floats(x, x_layout)?, floats(mask, mask_layout)?);
        let width = self.segments.len() * n;
        let mut y = vec![0.0; batches * width];
        self.each(batches, |batch, segment, from, to| {
            let y = &mut y[batch * width + segment * n..][..n];
            let mut first = true;
            for row in (from..to).filter(|&row| mask[row] > PADDING) {
                let x = &x[row * n..][..n];
                if first {
                    y.copy_from_slice(x);
                    first = false;
                } else {
                    for (y, x) in y.iter_mut().zip(x) {
                        *y = y.max(*x);
                    }
                }
            }
        });
        Ok((CpuStorage::F32(y), (batches, width).into()))
    }

    fn bwd(
        &self,
        x: &Tensor,
        mask: &Tensor,
        y: &Tensor,
        grad: &Tensor,
    ) -> Result<(Option<Tensor>, Option<Tensor>)> {
        let grad = grad.contiguous()?;
        let (batches, _, n) = x.dims3()?;
        let (xs, ms) = (x.storage_and_layout(), mask.storage_and_layout());
        let (ys, gs) = (y.storage_and_layout(), grad.storage_and_layout());
        let (xs, ms, ys, gs) = (numbers(&xs)?, numbers(&ms)?, numbers(&ys)?, numbers(&gs)?);
        let width = self.segments.len() * n;
        let mut x_grad = vec![0.0; xs.len()];
        let mut left = vec![0.0; n];
        self.each(batches, |batch, segment, from, to| {
            let at = batch * width + segment * n;
            let y = &ys[at..at + n];
            left.copy_from_slice(&gs[at..at + n]);
            for row in (from..to).filter(|&row| ms[row] > PADDING) {
                let (x, out) = (&xs[row * n..][..n], &mut x_grad[row * n..][..n]);
                for i in 0..n {
                    let taken = if x[i] == y[i] { left[i] } else { 0.0 };
                    out[i] = taken;
                    left[i] -= taken;
                }
            }
        });
        Ok((Some(tensor(x_grad, x)?), None))
    }
}

#[cfg(test)]
mod tests {
    use candle_core::{Device, Tensor, Var};

    use super::super::check::{compare, random, with_stock_forms};
    use super::segment_max;

    #[test]
    fn gradients_are_right() {
        let no = -1e4f32;
        let mask = Tensor::new(&[[0f32, 0.0, 0.0, 0.0, no], [no, no, no, 0.0, 0.0]], &Device::Cpu).unwrap();
        compare(&[random(&[2, 5, 4], 1)], |t| segment_max(&t[0], &mask.to_dtype(t[0].dtype())?, &[3, 2]));
    }

    #[test]
    fn one_of_tied_tokens_gets_the_gradient() {
        let x = Var::ones((1, 3, 2), candle_core::DType::F32, &Device::Cpu).unwrap();
        let mask = Tensor::new(&[[-1e4f32, 0.0, 0.0]], &Device::Cpu).unwrap();
        let gradient = || {
            let y = segment_max(x.as_tensor(), &mask, &[3]).unwrap();
            let grads = y.sum_all().unwrap().backward().unwrap();
            grads.get(x.as_tensor()).unwrap().squeeze(0).unwrap().to_vec2::<f32>().unwrap()
        };
        let first = [[0.0, 0.0], [1.0, 1.0], [0.0, 0.0]];
        assert_eq!(gradient(), first);
        assert_eq!(with_stock_forms(gradient), first);
    }
}
