//! The gate of multi-context gating: tokens times their context, blended into a running mean.

use candle_core::{CpuStorage, CustomOp3, Layout, Result, Shape, Tensor};

use super::raw::{floats, numbers, own_loops, tensor};

/// `keep * x + (1 - keep) * s * g`, where `x` and `s` are [batch, tokens, n] and the gate `g` [batch, n].
///
/// # Errors
/// When the shapes do not fit.
pub fn gate_mix(x: &Tensor, s: &Tensor, g: &Tensor, keep: f64) -> Result<Tensor> {
    if own_loops(x) {
        return x.contiguous()?.apply_op3(&s.contiguous()?, &g.contiguous()?, GateMix { keep: keep as f32 });
    }
    x.affine(keep, 0.0)? + s.broadcast_mul(&g.unsqueeze(1)?)?.affine(1.0 - keep, 0.0)?
}

struct GateMix {
    keep: f32,
}

impl CustomOp3 for GateMix {
    fn name(&self) -> &'static str {
        "gate-mix"
    }

    fn cpu_fwd(
        &self,
        x: &CpuStorage,
        x_layout: &Layout,
        s: &CpuStorage,
        s_layout: &Layout,
        g: &CpuStorage,
        g_layout: &Layout,
    ) -> Result<(CpuStorage, Shape)> {
        let (_, tokens, n) = x_layout.shape().dims3()?;
        let (x, s, g) = (floats(x, x_layout)?, floats(s, s_layout)?, floats(g, g_layout)?);
        let add = 1.0 - self.keep;
        let mut y = vec![0.0; x.len()];
        for (batch, gate) in g.chunks_exact(n).enumerate() {
            for row in batch * tokens..(batch + 1) * tokens {
                let (x, s) = (&x[row * n..][..n], &s[row * n..][..n]);
                for (i, y) in y[row * n..][..n].iter_mut().enumerate() {
                    *y = self.keep * x[i] + add * s[i] * gate[i];
                }
            }
        }
        Ok((CpuStorage::F32(y), x_layout.shape().clone()))
    }

    fn bwd(
        &self,
        x: &Tensor,
        s: &Tensor,
        g: &Tensor,
        _y: &Tensor,
        grad: &Tensor,
    ) -> Result<(Option<Tensor>, Option<Tensor>, Option<Tensor>)> {
        let grad = grad.contiguous()?;
        let (_, tokens, n) = x.dims3()?;
        let (ss, gates, grads) = (s.storage_and_layout(), g.storage_and_layout(), grad.storage_and_layout());
        let (ss, gates, grads) = (numbers(&ss)?, numbers(&gates)?, numbers(&grads)?);
        let add = 1.0 - self.keep;
        let (mut s_grad, mut g_grad) = (vec![0.0; ss.len()], vec![0.0; gates.len()]);
        for (batch, (gate, gate_grad)) in gates.chunks_exact(n).zip(g_grad.chunks_exact_mut(n)).enumerate() {
            for row in batch * tokens..(batch + 1) * tokens {
                let (s, dy) = (&ss[row * n..][..n], &grads[row * n..][..n]);
                for (i, ds) in s_grad[row * n..][..n].iter_mut().enumerate() {
                    *ds = add * dy[i] * gate[i];
                    gate_grad[i] += add * dy[i] * s[i];
                }
            }
        }
        let x_grad = grad.affine(f64::from(self.keep), 0.0)?;
        Ok((Some(x_grad), Some(tensor(s_grad, s)?), Some(tensor(g_grad, g)?)))
    }
}

#[cfg(test)]
mod tests {
    use super::super::check::{compare, random};
    use super::gate_mix;

    #[test]
    fn gradients_are_right() {
        let inputs = [random(&[2, 3, 5], 1), random(&[2, 3, 5], 2), random(&[2, 5], 3)];
        compare(&inputs, |t| gate_mix(&t[0], &t[1], &t[2], 0.6));
    }
}
