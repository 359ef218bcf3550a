//! Attention of a few queries to a set of tokens, all heads in one pass.

use candle_core::{CpuStorage, CustomOp3, D, Layout, Result, Shape, Tensor};

use super::raw::{add_scaled, dot, floats, numbers, own_loops, tensor};

/// Softmax attention. `q` is [batch, queries, n]. `kv` [batch, tokens, 2 n] has the keys before the values.
/// `mask` [batch, tokens] is added to the scores (0, or -1e4 at padding) and gets no gradient. Returns
/// [batch, queries, n].
///
/// # Errors
/// When the shapes do not fit.
pub fn attention(q: &Tensor, kv: &Tensor, mask: &Tensor, heads: usize) -> Result<Tensor> {
    if own_loops(q) {
        return q.contiguous()?.apply_op3(&kv.contiguous()?, &mask.contiguous()?, Attention { heads });
    }
    let (batch, queries, n) = q.dims3()?;
    let (tokens, width) = (kv.dim(1)?, n / heads);
    let split =
        |t: &Tensor, rows: usize| t.reshape((batch, rows, heads, width))?.transpose(1, 2)?.contiguous();
    let q = split(q, queries)?;
    let k = split(&kv.narrow(2, 0, n)?.contiguous()?, tokens)?;
    let v = split(&kv.narrow(2, n, n)?.contiguous()?, tokens)?;
    let scores = (q.matmul(&k.transpose(2, 3)?)? * (1.0 / (width as f64).sqrt()))?;
    let scores = scores.broadcast_add(&mask.reshape((batch, 1, 1, tokens))?)?;
    let shares = candle_nn::ops::softmax(&scores, D::Minus1)?;
    shares.matmul(&v)?.transpose(1, 2)?.contiguous()?.reshape((batch, queries, n))
}

struct Attention {
    heads: usize,
}

/// Sizes of a call.
#[derive(Clone, Copy)]
struct Sizes {
    batches: usize,
    queries: usize,
    tokens: usize,
    n: usize,
    width: usize,
}

impl Attention {
    fn sizes(&self, q: (usize, usize, usize), kv: (usize, usize, usize)) -> Result<Sizes> {
        let ((batches, queries, n), (kv_batches, tokens, double)) = (q, kv);
        if double != 2 * n || kv_batches != batches || n % self.heads != 0 {
            candle_core::bail!("attention of {q:?} to {kv:?} with {} heads", self.heads);
        }
        Ok(Sizes { batches, queries, tokens, n, width: n / self.heads })
    }
}

impl Sizes {
    fn key<'a>(&self, kv: &'a [f32], batch: usize, token: usize, head: usize) -> &'a [f32] {
        &kv[(batch * self.tokens + token) * 2 * self.n + head * self.width..][..self.width]
    }

    fn value<'a>(&self, kv: &'a [f32], batch: usize, token: usize, head: usize) -> &'a [f32] {
        &kv[(batch * self.tokens + token) * 2 * self.n + self.n + head * self.width..][..self.width]
    }

    fn query_at(&self, batch: usize, query: usize, head: usize) -> usize {
        (batch * self.queries + query) * self.n + head * self.width
    }

    fn scale(&self) -> f32 {
        1.0 / (self.width as f32).sqrt()
    }

    /// Fills `shares` with the softmax over the tokens.
    fn shares(&self, q: &[f32], kv: &[f32], mask: &[f32], batch: usize, head: usize, shares: &mut [f32]) {
        let (scale, mut top) = (self.scale(), f32::NEG_INFINITY);
        for (token, share) in shares.iter_mut().enumerate() {
            *share = scale * dot(q, self.key(kv, batch, token, head)) + mask[batch * self.tokens + token];
            top = top.max(*share);
        }
        let mut total = 0.0;
        for share in shares.iter_mut() {
            *share = (*share - top).exp();
            total += *share;
        }
        for share in shares.iter_mut() {
            *share /= total;
        }
    }
}

impl CustomOp3 for Attention {
    fn name(&self) -> &'static str {
        "attention"
    }

    fn cpu_fwd(
        &self,
        q: &CpuStorage,
        q_layout: &Layout,
        kv: &CpuStorage,
        kv_layout: &Layout,
        mask: &CpuStorage,
        mask_layout: &Layout,
    ) -> Result<(CpuStorage, Shape)> {
        let sizes = self.sizes(q_layout.shape().dims3()?, kv_layout.shape().dims3()?)?;
        let (q, kv, mask) = (floats(q, q_layout)?, floats(kv, kv_layout)?, floats(mask, mask_layout)?);
        let mut y = vec![0.0; q.len()];
        let mut shares = vec![0.0; sizes.tokens];
        for batch in 0..sizes.batches {
            for head in 0..self.heads {
                for query in 0..sizes.queries {
                    let at = sizes.query_at(batch, query, head);
                    sizes.shares(&q[at..at + sizes.width], kv, mask, batch, head, &mut shares);
                    let y = &mut y[at..at + sizes.width];
                    for (token, share) in shares.iter().enumerate() {
                        add_scaled(y, *share, sizes.value(kv, batch, token, head));
                    }
                }
            }
        }
        Ok((CpuStorage::F32(y), q_layout.shape().clone()))
    }

    fn bwd(
        &self,
        q: &Tensor,
        kv: &Tensor,
        mask: &Tensor,
        _y: &Tensor,
        grad: &Tensor,
    ) -> Result<(Option<Tensor>, Option<Tensor>, Option<Tensor>)> {
        let sizes = self.sizes(q.dims3()?, kv.dims3()?)?;
        let grad = grad.contiguous()?;
        let (qs, kvs) = (q.storage_and_layout(), kv.storage_and_layout());
        let (ms, gs) = (mask.storage_and_layout(), grad.storage_and_layout());
        let (qs, kvs, ms, gs) = (numbers(&qs)?, numbers(&kvs)?, numbers(&ms)?, numbers(&gs)?);
        let (mut q_grad, mut kv_grad) = (vec![0.0; qs.len()], vec![0.0; kvs.len()]);
        let (mut shares, mut slopes) = (vec![0.0; sizes.tokens], vec![0.0; sizes.tokens]);
        let (n, width, scale) = (sizes.n, sizes.width, sizes.scale());
        for batch in 0..sizes.batches {
            for head in 0..self.heads {
                for query in 0..sizes.queries {
                    let at = sizes.query_at(batch, query, head);
                    let (q, dy) = (&qs[at..at + width], &gs[at..at + width]);
                    sizes.shares(q, kvs, ms, batch, head, &mut shares);
                    for (token, slope) in slopes.iter_mut().enumerate() {
                        *slope = dot(dy, sizes.value(kvs, batch, token, head));
                    }
                    let mean = dot(&shares, &slopes);
                    let dq = &mut q_grad[at..at + width];
                    for token in 0..sizes.tokens {
                        let slope = scale * shares[token] * (slopes[token] - mean);
                        add_scaled(dq, slope, sizes.key(kvs, batch, token, head));
                        let row = (batch * sizes.tokens + token) * 2 * n + head * width;
                        add_scaled(&mut kv_grad[row..row + width], slope, q);
                        add_scaled(&mut kv_grad[row + n..row + n + width], shares[token], dy);
                    }
                }
            }
        }
        Ok((Some(tensor(q_grad, q)?), Some(tensor(kv_grad, kv)?), None))
    }
}

#[cfg(test)]
mod tests {
    use candle_core::{Device, Tensor};

    use super::super::check::{compare, random};
    use super::attention;

    #[test]
    fn gradients_are_right() {
        let no = -1e4f32;
        let mask = Tensor::new(&[[0f32, 0.0, no, 0.0], [no, 0.0, 0.0, no]], &Device::Cpu).unwrap();
        compare(&[random(&[2, 3, 8], 1), random(&[2, 4, 16], 2)], |t| {
            attention(&t[0], &t[1], &mask.to_dtype(t[0].dtype())?, 2)
        });
    }
}
