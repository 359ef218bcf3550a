//! Device that computes the networks of a training run.

use candle_core::{DType, Device, Result, Tensor};

use super::TrainError;

/// Device that computes the networks. Records, losses and the optimiser stay on the CPU.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, clap::ValueEnum)]
pub enum Processor {
    /// The CPU, where a run repeats bit for bit.
    #[default]
    Cpu,
    /// The first NVIDIA graphics card, in a program built with the feature `cuda`.
    Cuda,
}

impl Processor {
    pub(super) fn device(self) -> std::result::Result<Device, TrainError> {
        let none = |reason: String| TrainError::Device(reason);
        match self {
            Self::Cpu => Ok(Device::Cpu),
            Self::Cuda if !cfg!(feature = "cuda") => {
                Err(none("this program was built without the cargo feature \"cuda\"".into()))
            }
            Self::Cuda => first_card().map_err(|error| none(error.to_string())),
        }
    }
}

/// The first graphics card. A test operation reports at once a driver that is too old for the kernels.
fn first_card() -> Result<Device> {
    let device = Device::new_cuda(0)?;
    (Tensor::zeros(1, DType::F32, &device)? + 1.0)?.to_vec1::<f32>()?;
    Ok(device)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_card_that_is_not_there_is_told_of() {
        assert!(Processor::Cpu.device().unwrap().is_cpu());
        match Processor::Cuda.device() {
            Ok(device) => assert!(cfg!(feature = "cuda") && device.is_cuda()),
            Err(error) => assert!(error.to_string().starts_with("no CUDA device"), "{error}"),
        }
    }
}
