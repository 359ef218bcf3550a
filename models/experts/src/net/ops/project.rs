//! A small matrix for each road user, applied to each of its modes.

use candle_core::{CpuStorage, CustomOp2, Layout, Result, Shape, Tensor};

use super::raw::{dot, floats, numbers, own_loops, tensor};

/// `P r` for the halves of each residual. `r` is [batch, modes, 2 k]: k along knots, then k across
/// knots; `p` is [batch, 2, k, k], one matrix for each half. `p` gets no gradient.
///
/// # Errors
/// When the shapes do not fit.
pub fn project(r: &Tensor, p: &Tensor) -> Result<Tensor> {
    let (r, p) = (r.contiguous()?, p.contiguous()?);
    if own_loops(&r) {
        return r.apply_op2(&p, Project { transposed: false });
    }
    let (batch, modes, numbers) = r.dims3()?;
    let halves = r.reshape((batch, modes, 2, numbers / 2))?.transpose(1, 2)?.contiguous()?;
    let moved = halves.matmul(&p.transpose(2, 3)?.contiguous()?)?;
    moved.transpose(1, 2)?.contiguous()?.reshape((batch, modes, numbers))
}

struct Project {
    transposed: bool,
}

impl Project {
    fn apply(&self, r: &[f32], p: &[f32], batches: usize, k: usize) -> Vec<f32> {
        let mut y = vec![0.0; r.len()];
        if batches == 0 {
            return y;
        }
        let per_batch = r.len() / batches;
        for batch in 0..batches {
            for at in (0..per_batch).step_by(k) {
                let half = at / k % 2;
                let matrix = &p[(batch * 2 + half) * k * k..][..k * k];
                let (r, y) = (&r[batch * per_batch + at..][..k], &mut y[batch * per_batch + at..][..k]);
                for (i, row) in matrix.chunks_exact(k).enumerate() {
                    if self.transposed {
                        for (y, m) in y.iter_mut().zip(row) {
                            *y += m * r[i];
                        }
                    } else {
                        y[i] = dot(row, r);
                    }
                }
            }
        }
        y
    }
}

impl CustomOp2 for Project {
    fn name(&self) -> &'static str {
        "project"
    }

    fn cpu_fwd(
        &self,
        r: &CpuStorage,
        r_layout: &Layout,
        p: &CpuStorage,
        p_layout: &Layout,
    ) -> Result<(CpuStorage, Shape)> {
        let (batches, two, k, _) = p_layout.shape().dims4()?;
        let shape = r_layout.shape();
        if two != 2 || shape.dims3()?.0 != batches || shape.dims3()?.2 != 2 * k {
            candle_core::bail!("projection {:?} does not fit residuals {shape:?}", p_layout.shape());
        }
        let y = self.apply(floats(r, r_layout)?, floats(p, p_layout)?, batches, k);
        Ok((CpuStorage::F32(y), shape.clone()))
    }

    fn bwd(
        &self,
        r: &Tensor,
        p: &Tensor,
        _y: &Tensor,
        grad: &Tensor,
    ) -> Result<(Option<Tensor>, Option<Tensor>)> {
        let grad = grad.contiguous()?;
        let (batches, _, k, _) = p.dims4()?;
        let (gs, ps) = (grad.storage_and_layout(), p.storage_and_layout());
        let back = Project { transposed: !self.transposed };
        Ok((Some(tensor(back.apply(numbers(&gs)?, numbers(&ps)?, batches, k), r)?), None))
    }
}

#[cfg(test)]
mod tests {
    use super::super::check::{compare, random};
    use super::project;

    #[test]
    fn gradients_are_right() {
        let p = random(&[2, 2, 4, 4], 9);
        compare(&[random(&[2, 3, 8], 1)], |t| project(&t[0], &p.to_dtype(t[0].dtype())?));
    }
}
