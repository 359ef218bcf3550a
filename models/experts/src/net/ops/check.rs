//! Compares an operation with its stock form and with finite differences, for tests.

use std::cell::Cell;

use candle_core::{DType, Device, Result, Tensor, Var};
use scene::random::Key;

thread_local! {
    static STOCK: Cell<bool> = const { Cell::new(false) };
}

/// Runs a closure with the stock forms instead of our own loops, as on a GPU.
pub(crate) fn with_stock_forms<T>(run: impl FnOnce() -> T) -> T {
    STOCK.set(true);
    let result = run();
    STOCK.set(false);
    result
}

/// Whether this thread is within [`with_stock_forms`].
pub(super) fn stock_forms_wanted() -> bool {
    STOCK.get()
}

/// Seeded distinct numbers in -1..1.
pub(crate) fn random(shape: &[usize], seed: u64) -> Tensor {
    let mut stream = Key::default().number(seed).stream();
    let values: Vec<f32> =
        (0..shape.iter().product::<usize>()).map(|_| stream.between(-1.0, 1.0) as f32).collect();
    Tensor::from_vec(values, shape, &Device::Cpu).unwrap()
}

/// A weighted sum of an output, so that each element has a different gradient.
fn weighted(output: &Tensor) -> f64 {
    weighted_tensor(output).to_dtype(DType::F64).unwrap().to_scalar::<f64>().unwrap()
}

fn weighted_tensor(output: &Tensor) -> Tensor {
    let weights = random(output.dims(), 99).to_dtype(output.dtype()).unwrap();
    (output * weights).unwrap().sum_all().unwrap()
}

fn gradients(
    inputs: &[Tensor],
    dtype: DType,
    run: &impl Fn(&[Tensor]) -> Result<Tensor>,
) -> (Tensor, Vec<Tensor>) {
    let vars: Vec<Var> =
        inputs.iter().map(|t| Var::from_tensor(&t.to_dtype(dtype).unwrap()).unwrap()).collect();
    let tensors: Vec<Tensor> = vars.iter().map(|v| v.as_tensor().clone()).collect();
    let output = run(&tensors).unwrap();
    let grads = weighted_tensor(&output).backward().unwrap();
    let grads = tensors.iter().map(|t| grads.get(t).unwrap().to_dtype(DType::F64).unwrap()).collect();
    (output.to_dtype(DType::F64).unwrap(), grads)
}

fn largest_difference(a: &Tensor, b: &Tensor) -> f64 {
    (a - b).unwrap().abs().unwrap().flatten_all().unwrap().max(0).unwrap().to_scalar::<f64>().unwrap()
}

/// Our loops and the stock form, both in f32, must equal the stock form in f64 in value and gradient. Its
/// gradient must equal central differences in f64.
pub(crate) fn compare(inputs: &[Tensor], run: impl Fn(&[Tensor]) -> Result<Tensor>) {
    let (stock, stock_grads) = gradients(inputs, DType::F64, &run);
    let own = gradients(inputs, DType::F32, &run);
    let single = with_stock_forms(|| gradients(inputs, DType::F32, &run));
    for (form, (value, grads)) in [("our own", own), ("the stock form's", single)] {
        let difference = largest_difference(&value, &stock);
        assert!(difference < 1e-5, "{form} values differ by {difference}");
        for (index, (grad, stock)) in grads.iter().zip(&stock_grads).enumerate() {
            let difference = largest_difference(grad, stock);
            assert!(difference < 2e-5, "{form} gradient of input {index} differs by {difference}");
        }
    }
    let doubles: Vec<Tensor> = inputs.iter().map(|t| t.to_dtype(DType::F64).unwrap()).collect();
    for (index, grad) in stock_grads.iter().enumerate() {
        let grad = grad.flatten_all().unwrap().to_vec1::<f64>().unwrap();
        let values = doubles[index].flatten_all().unwrap().to_vec1::<f64>().unwrap();
        for element in 0..values.len() {
            let at = |delta: f64| {
                let mut moved = values.clone();
                moved[element] += delta;
                let mut inputs = doubles.clone();
                inputs[index] = Tensor::from_vec(moved, doubles[index].shape(), &Device::Cpu).unwrap();
                weighted(&run(&inputs).unwrap())
            };
            let slope = (at(1e-6) - at(-1e-6)) / 2e-6;
            assert!(
                (slope - grad[element]).abs() < 1e-6,
                "input {index}, element {element}: {slope} {}",
                grad[element]
            );
        }
    }
}
