//! Sources of a network's parameters: seeded random draws or a file.

use std::collections::BTreeMap;

use candle_core::{DType, Device, Tensor, Var};
use scene::random::{Key, Stream};

use super::error::NetError;

/// Initial value of a parameter.
#[derive(Clone, Copy, Debug)]
pub enum Init {
    /// All the same.
    Constant(f64),
    /// Normal with this deviation.
    Normal(f64),
}

#[allow(clippy::large_enum_variant, reason = "one exists while a network is put together")]
enum ParamSource {
    Random(Stream),
    Given(BTreeMap<String, Tensor>),
}

/// Parameters by name, and their variables if they are trainable.
pub type Finished = (BTreeMap<String, Tensor>, BTreeMap<String, Var>);

/// Provides parameters by name while a network is built.
pub struct Params {
    source: ParamSource,
    device: Device,
    trainable: bool,
    made: BTreeMap<String, Tensor>,
    vars: BTreeMap<String, Var>,
}

impl Params {
    /// Parameters drawn from a seed, equal on every machine.
    pub fn random(seed: u64, trainable: bool, device: &Device) -> Self {
        Self::new(
            ParamSource::Random(Key::default().text("weights").number(seed).stream()),
            trainable,
            device,
        )
    }

    /// Parameters of a file.
    pub fn given(tensors: BTreeMap<String, Tensor>, trainable: bool, device: &Device) -> Self {
        Self::new(ParamSource::Given(tensors), trainable, device)
    }

    fn new(source: ParamSource, trainable: bool, device: &Device) -> Self {
        Self { source, device: device.clone(), trainable, made: BTreeMap::new(), vars: BTreeMap::new() }
    }

    /// The parameter `name` of a shape; contiguous.
    ///
    /// # Errors
    /// When a file lacks it or has it in another shape.
    pub fn get(&mut self, name: &str, shape: &[usize], init: Init) -> Result<Tensor, NetError> {
        let tensor = match &mut self.source {
            ParamSource::Random(rng) => {
                let count = shape.iter().product::<usize>();
                let values: Vec<f32> = match init {
                    Init::Constant(value) => vec![value as f32; count],
                    Init::Normal(deviation) => {
                        (0..count).map(|_| (deviation * rng.normal()) as f32).collect()
                    }
                };
                Tensor::from_vec(values, shape, &self.device)?
            }
            ParamSource::Given(tensors) => {
                let tensor = tensors.remove(name).ok_or_else(|| NetError::Missing(name.into()))?;
                if tensor.dims() != shape || tensor.dtype() != DType::F32 {
                    return Err(NetError::Shape {
                        name: name.into(),
                        found: format!("{:?} {:?}", tensor.dtype(), tensor.dims()),
                        expected: format!("F32 {shape:?}"),
                    });
                }
                tensor.to_device(&self.device)?.contiguous()?
            }
        };
        let tensor = if self.trainable {
            let var = Var::from_tensor(&tensor)?;
            let tensor = var.as_tensor().clone();
            self.vars.insert(name.into(), var);
            tensor
        } else {
            tensor
        };
        self.made.insert(name.into(), tensor.clone());
        Ok(tensor)
    }

    /// Device of the parameters.
    pub fn device(&self) -> &Device {
        &self.device
    }

    /// All provided parameters, and their variables if they are trainable.
    ///
    /// # Errors
    /// When a file has tensors that no part of the network uses.
    pub fn finish(self) -> Result<Finished, NetError> {
        if let ParamSource::Given(left) = &self.source
            && let Some((name, tensor)) = left.first_key_value()
        {
            return Err(NetError::Shape {
                name: name.clone(),
                found: format!("{:?} {:?}", tensor.dtype(), tensor.dims()),
                expected: "absent: the architecture has no such tensor".into(),
            });
        }
        Ok((self.made, self.vars))
    }
}
