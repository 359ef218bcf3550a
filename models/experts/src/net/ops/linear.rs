//! `x W + b`, optionally with a rectifier.

use candle_core::backend::BackendStorage;
use candle_core::{CpuStorage, CustomOp3, Layout, Result, Shape, Tensor};

use super::raw::{add_scaled, floats, numbers, own_loops, tensor};

/// `x W + b` and, with `relu`, its positive part. `x` is [.., in], `weight` a contiguous [in, out]
/// (transposed views cost two to five times as much for few rows), `bias` [out]. Returns [.., out].
///
/// # Errors
/// When the shapes do not fit.
pub fn linear(x: &Tensor, weight: &Tensor, bias: &Tensor, relu: bool) -> Result<Tensor> {
    let (inputs, outputs) = weight.dims2()?;
    let rows = x.elem_count() / inputs.max(1);
    let flat = x.reshape((rows, inputs))?.contiguous()?;
    let y = if own_loops(x) {
        flat.apply_op3(weight, bias, LinearOp { relu })?
    } else {
        let y = flat.matmul(weight)?.broadcast_add(bias)?;
        if relu { rectified(&y)? } else { y }
    };
    let mut shape = x.dims().to_vec();
    if let Some(last) = shape.last_mut() {
        *last = outputs;
    }
    y.reshape(shape)
}

/// The positive part, with gradient zero at 0 as in our own loops; candle's own passes the full gradient
/// there.
fn rectified(x: &Tensor) -> Result<Tensor> {
    x * x.gt(0.0)?.to_dtype(x.dtype())?
}

struct LinearOp {
    relu: bool,
}

impl CustomOp3 for LinearOp {
    fn name(&self) -> &'static str {
        "linear"
    }

    fn cpu_fwd(
        &self,
        x: &CpuStorage,
        x_layout: &Layout,
        weight: &CpuStorage,
        weight_layout: &Layout,
        bias: &CpuStorage,
        bias_layout: &Layout,
    ) -> Result<(CpuStorage, Shape)> {
        let (rows, inputs) = x_layout.shape().dims2()?;
        let (_, outputs) = weight_layout.shape().dims2()?;
        let bias = floats(bias, bias_layout)?;
        let mut y = x.matmul(weight, (1, rows, outputs, inputs), x_layout, weight_layout)?;
        let CpuStorage::F32(values) = &mut y else { candle_core::bail!("linear is for f32") };
        for row in values.chunks_exact_mut(outputs) {
            for (value, bias) in row.iter_mut().zip(bias) {
                *value += bias;
                if self.relu {
                    *value = value.max(0.0);
                }
            }
        }
        Ok((y, (rows, outputs).into()))
    }

    fn bwd(
        &self,
        x: &Tensor,
        weight: &Tensor,
        bias: &Tensor,
        y: &Tensor,
        grad: &Tensor,
    ) -> Result<(Option<Tensor>, Option<Tensor>, Option<Tensor>)> {
        let mut grad = grad.contiguous()?;
        if self.relu {
            grad = masked(&grad, y)?;
        }
        let bias_grad = if bias.track_op() { Some(column_sums(&grad, bias)?) } else { None };
        let x_grad = if x.track_op() { Some(grad.matmul(&weight.t()?)?) } else { None };
        let weight_grad = if weight.track_op() { Some(x.t()?.matmul(&grad)?) } else { None };
        Ok((x_grad, weight_grad, bias_grad))
    }
}

/// The gradient where the output was positive.
fn masked(grad: &Tensor, y: &Tensor) -> Result<Tensor> {
    let (g, v) = (grad.storage_and_layout(), y.storage_and_layout());
    let (g, v) = (numbers(&g)?, numbers(&v)?);
    tensor(g.iter().zip(v).map(|(g, v)| if *v > 0.0 { *g } else { 0.0 }).collect(), y)
}

fn column_sums(grad: &Tensor, bias: &Tensor) -> Result<Tensor> {
    let guard = grad.storage_and_layout();
    let mut sums = vec![0.0; bias.elem_count()];
    for row in numbers(&guard)?.chunks_exact(sums.len()) {
        add_scaled(&mut sums, 1.0, row);
    }
    tensor(sums, bias)
}

#[cfg(test)]
mod tests {
    use candle_core::{DType, Device, Var};

    use super::super::check::{compare, random, with_stock_forms};
    use super::linear;

    #[test]
    fn gradients_are_right() {
        for relu in [false, true] {
            let inputs = [random(&[2, 3, 5], 1), random(&[5, 7], 2), random(&[7], 3)];
            compare(&inputs, |t| linear(&t[0], &t[1], &t[2], relu));
        }
    }

    #[test]
    fn nothing_flows_back_through_zero() {
        let zero = |shape: &[usize]| Var::zeros(shape, DType::F32, &Device::Cpu).unwrap();
        let (x, weight, bias) = (zero(&[2, 3]), zero(&[3, 2]), zero(&[2]));
        let slope = || {
            let y = linear(x.as_tensor(), weight.as_tensor(), bias.as_tensor(), true).unwrap();
            let grads = y.sum_all().unwrap().backward().unwrap();
            grads.get(bias.as_tensor()).unwrap().to_vec1::<f32>().unwrap()
        };
        assert_eq!((slope(), with_stock_forms(slope)), (vec![0.0; 2], vec![0.0; 2]));
    }
}
