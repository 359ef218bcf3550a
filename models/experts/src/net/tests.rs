//! Tests of whole networks: gradients, files, and bit-equal results for one road user and for a batch.

use candle_core::{DType, Device, Tensor};
use scene::random::Key;

use super::inputs::EncounterTensors;
use super::*;
use crate::features::encounters::Encounters;
use crate::features::{AgentFeatures, NEIGHBOURS};
use crate::planning::{MODES, RESIDUAL};

/// A road user with `neighbours` neighbours, whose last along knot a goal holds fixed.
fn agent(neighbours: usize, seed: u64) -> AgentFeatures {
    let mut rng = Key::default().number(seed).stream();
    let mut draw = || rng.normal() as f32;
    let mut tangent = Box::new([[[0.0; scene::KNOTS]; scene::KNOTS]; 2]);
    for knot in 0..scene::KNOTS {
        tangent[0][knot][knot] = if knot == scene::KNOTS - 1 { 0.0 } else { 1.0 };
        tangent[1][knot][knot] = if knot == 0 { 0.0 } else { 1.0 };
    }
    AgentFeatures {
        own: std::array::from_fn(|_| draw()),
        neighbours: (0..neighbours).map(|_| std::array::from_fn(|_| draw())).collect(),
        anchors: Box::new(std::array::from_fn(|_| std::array::from_fn(|_| draw()))),
        tangent,
    }
}

fn agents() -> Vec<AgentFeatures> {
    [2, NEIGHBOURS, 0, 1, NEIGHBOURS - 1].iter().zip(0..).map(|(others, seed)| agent(*others, seed)).collect()
}

fn drafts(batch: usize, seed: u64) -> Vec<[[f32; RESIDUAL]; MODES]> {
    let mut rng = Key::default().number(seed).stream();
    (0..batch).map(|_| std::array::from_fn(|_| std::array::from_fn(|_| rng.normal() as f32))).collect()
}

/// Encounters that depend only on the drafts: none beside the first mode, one more beside each next one.
fn encounters_of(draft: &[[f32; RESIDUAL]; MODES]) -> Encounters {
    std::array::from_fn(|mode| {
        (0..mode).map(|k| std::array::from_fn(|i| draft[mode][(i + k) % RESIDUAL])).collect()
    })
}

/// All outputs of inference, for some of the road users.
fn answers(
    expert: &Expert,
    agents: &[&AgentFeatures],
    noise: &[[[f32; RESIDUAL]; MODES]],
) -> (InitialOutput, Vec<[[f32; RESIDUAL]; MODES]>) {
    let context = expert.encode(agents).unwrap();
    let initial = expert.initialize(&context).unwrap();
    let prepared = expert.prepare_refine(&context).unwrap();
    let mut draft = expert.add_noise(&prepared, &initial.residual, noise, 20).unwrap();
    for levels in schedule::ddim(20, 3) {
        let encounters: Vec<Encounters> = draft.iter().map(encounters_of).collect();
        let encounters: Vec<&Encounters> = encounters.iter().collect();
        draft = expert.refine_step(&prepared, &draft, (noise, &encounters), levels, Some(noise)).unwrap();
    }
    (initial, draft)
}

#[test]
fn alone_and_in_a_batch_bits_are_equal() {
    let expert = Expert::load_trainable(&Expert::random(3).unwrap().save().unwrap(), &Device::Cpu).unwrap();
    let expert = expert.with_attention(1, 5).unwrap();
    let agents = agents();
    let all: Vec<&AgentFeatures> = (0..17).map(|i| &agents[i % agents.len()]).collect();
    let noise = drafts(all.len(), 5);
    let (initial, refined) = answers(&expert, &all, &noise);
    for i in 0..agents.len() {
        let (one, draft) = answers(&expert, &all[i..i + 1], &noise[i..i + 1]);
        assert_eq!(one.residual[0], initial.residual[i], "residual of {i}");
        assert_eq!(one.scale[0], initial.scale[i], "scale of {i}");
        assert_eq!(one.log_prob[0], initial.log_prob[i], "probability of {i}");
        assert_eq!(one.stays[0], initial.stays[i], "stays of {i}");
        assert_eq!(draft[0], refined[i], "refined draft of {i}");
    }
    let (again, draft) = answers(&expert, &all, &noise);
    assert_eq!((again, draft), (initial, refined));
}

#[test]
fn answers_keep_the_goal() {
    let expert = Expert::random(4).unwrap();
    let agents = agents();
    let all: Vec<&AgentFeatures> = agents.iter().collect();
    let (initial, refined) = answers(&expert, &all, &drafts(all.len(), 5));
    for residual in initial.residual.iter().chain(&refined).flatten() {
        assert_eq!((residual[scene::KNOTS - 1], residual[scene::KNOTS]), (0.0, 0.0));
        assert!(residual.iter().all(|r| r.is_finite()) && residual.iter().any(|r| *r != 0.0));
    }
}

#[test]
fn a_file_gives_the_same_expert() {
    let expert = Expert::random(3).unwrap();
    let bytes = expert.save().unwrap();
    let loaded = Expert::load(&bytes).unwrap();
    assert_eq!(loaded.card, expert.card);
    assert_eq!(loaded.save().unwrap(), bytes);
    let agents = agents();
    let all: Vec<&AgentFeatures> = agents.iter().collect();
    let noise = drafts(all.len(), 5);
    assert_eq!(answers(&loaded, &all, &noise), answers(&expert, &all, &noise));
    assert!((500_000..2_000_000).contains(&expert.parameters()), "{} parameters", expert.parameters());
    assert!(loaded.vars().is_empty());
}

#[test]
fn attention_is_added_to_trained_weights_and_kept_in_the_file() {
    let expert = Expert::random(3).unwrap();
    assert!(!expert.attends());
    let bytes = expert.save().unwrap();
    assert!(!String::from_utf8_lossy(&bytes[..2000]).contains("refiner_attention"));
    let grown = Expert::load_trainable(&bytes, &Device::Cpu).unwrap().with_attention(1, 5).unwrap();
    let loaded = Expert::load(&grown.save().unwrap()).unwrap();
    assert!(loaded.attends() && loaded.parameters() > expert.parameters() + 100_000);
    let agents = agents();
    let all: Vec<&AgentFeatures> = agents.iter().collect();
    let noise = drafts(all.len(), 5);
    let ((before, plain), (after, attending)) =
        (answers(&expert, &all, &noise), answers(&loaded, &all, &noise));
    assert_eq!(before, after, "the initializer is the same");
    assert_ne!(plain, attending);
}

#[test]
fn wrong_files_are_refused_with_the_reason() {
    let reason = |bytes: &[u8]| Expert::load(bytes).unwrap_err().to_string();
    assert!(reason(b"nothing").contains("not a safetensors file"));
    let expert = Expert::random(3).unwrap();
    let tensor = Tensor::zeros((2, 3), DType::F32, &Device::Cpu).unwrap();
    let alone = |header: Option<&str>| {
        let header = header.map(|text| [("dragtraffic".to_owned(), text.to_owned())].into());
        safetensors::serialize([("context.blocks.0.token.weight", &tensor)], header).unwrap()
    };
    assert!(reason(&alone(None)).contains("not an expert's weights"));
    assert!(reason(&alone(Some("{}"))).contains("architecture"));
    let card = serde_json::to_value(&expert.card).unwrap();
    let mut architecture = serde_json::to_value(&expert.architecture).unwrap();
    let header = serde_json::json!({ "architecture": architecture, "card": card }).to_string();
    let message = reason(&alone(Some(&header)));
    assert!(message.contains("context.blocks.0.token.weight") && message.contains("[2, 3]"), "{message}");
    architecture["version"] = 9.into();
    let header = serde_json::json!({ "architecture": architecture, "card": card }).to_string();
    assert!(reason(&alone(Some(&header))).contains("version 9"));
}

/// A scalar that depends on every output of an expert.
fn probe(expert: &Expert, agents: &[&AgentFeatures]) -> Tensor {
    let context = expert.encode(agents).unwrap();
    let initial = expert.initializer.forward(&context).unwrap();
    let prepared = expert.refiner.prepare(&context).unwrap();
    let weigh = |tensor: &Tensor, seed: u64| {
        let weights = ops::check::random(tensor.dims(), seed);
        (tensor * weights).unwrap().sum_all().unwrap()
    };
    let push = ops::check::random(initial.residual.dims(), 8);
    let levels: Vec<usize> = (0..agents.len()).map(|i| 7 * i).collect();
    let drafts = drafts(agents.len(), 9);
    let encounters: Vec<Encounters> = drafts.iter().map(encounters_of).collect();
    let encounters: Vec<&Encounters> = encounters.iter().collect();
    let encounters = EncounterTensors::stack(&encounters, &Device::Cpu).unwrap();
    let inputs = DraftInputs { push: &push, encounters: Some(&encounters) };
    let refined = expert.refiner.denoise(&prepared, &initial.residual, &inputs, &levels).unwrap();
    let parts = [
        weigh(&refined, 1),
        weigh(&initial.residual, 2),
        weigh(&initial.log_scale, 3),
        weigh(&initial.log_prob().unwrap(), 4),
        weigh(&initial.stays, 5),
    ];
    parts.into_iter().reduce(|a, b| (a + b).unwrap()).unwrap()
}

#[test]
fn stock_forms_make_the_same_network() {
    let expert = Expert::trainable(small(), Expert::random(1).unwrap().card, 11, &Device::Cpu).unwrap();
    let agents = agents();
    let all: Vec<&AgentFeatures> = agents.iter().collect();
    let run = || {
        let value = probe(&expert, &all);
        (value.to_scalar::<f32>().unwrap(), value.backward().unwrap())
    };
    let ((own, own_grads), (stock, stock_grads)) = (run(), ops::check::with_stock_forms(run));
    assert!((own - stock).abs() < 1e-4 * own.abs().max(1.0), "{own} {stock}");
    for (name, var) in expert.vars() {
        let numbers = |grads: &candle_core::backprop::GradStore| -> Vec<f32> {
            let grad = grads.get(var.as_tensor()).unwrap_or_else(|| panic!("{name} has no gradient"));
            grad.flatten_all().unwrap().to_vec1().unwrap()
        };
        let (own, stock) = (numbers(&own_grads), numbers(&stock_grads));
        let length = own.iter().map(|g| g * g).sum::<f32>().sqrt();
        let apart = own.iter().zip(&stock).map(|(a, b)| (a - b) * (a - b)).sum::<f32>().sqrt();
        assert!(length > 0.0 && apart < 1e-4 * length, "{name}: {apart} of {length}");
    }
}

fn small() -> Architecture {
    Architecture { width: 16, gating_blocks: 2, heads: 2, refiner_attention: 1, ..Architecture::default() }
}

#[test]
fn every_variable_has_a_gradient_that_matches_differences() {
    let expert = Expert::trainable(small(), Expert::random(1).unwrap().card, 11, &Device::Cpu).unwrap();
    let agents = agents();
    let all: Vec<&AgentFeatures> = agents.iter().take(3).collect();
    let value = || f64::from(probe(&expert, &all).to_scalar::<f32>().unwrap());
    let grads = probe(&expert, &all).backward().unwrap();
    let mut rng = Key::default().number(2).stream();
    for (name, var) in expert.vars() {
        let grad = grads.get(var.as_tensor()).unwrap_or_else(|| panic!("{name} has no gradient"));
        let norm = grad.sqr().unwrap().sum_all().unwrap().to_scalar::<f32>().unwrap().sqrt();
        assert!(norm > 0.0 && norm.is_finite(), "{name} has gradient norm {norm}");
        // Along the gradient and a random direction, the slope must be the inner product.
        let before = var.as_tensor().copy().unwrap();
        let random: Vec<f32> = (0..before.elem_count()).map(|_| rng.normal() as f32).collect();
        let random = Tensor::from_vec(random, before.shape(), &Device::Cpu).unwrap();
        let unit = (grad / f64::from(norm)).unwrap();
        let length = random.sqr().unwrap().sum_all().unwrap().to_scalar::<f32>().unwrap().sqrt();
        let direction = (unit + (random / f64::from(length)).unwrap()).unwrap();
        let expected = f64::from((&direction * grad).unwrap().sum_all().unwrap().to_scalar::<f32>().unwrap());
        let step = 2e-3 / f64::from(norm).sqrt().max(1.0);
        let at = |delta: f64| {
            var.set(&(&before + (&direction * delta).unwrap()).unwrap()).unwrap();
            value()
        };
        let slope = (at(step) - at(-step)) / (2.0 * step);
        var.set(&before).unwrap();
        let tolerance = 0.05 * expected.abs() + 0.02;
        assert!((slope - expected).abs() < tolerance, "{name}: slope {slope}, gradient says {expected}");
    }
}
