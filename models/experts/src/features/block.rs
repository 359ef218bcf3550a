//! Blocks of inputs as tables: each input has a name, a unit and a scale, defined once. Widths, indices, the
//! arrays of the networks, their documentation and the hash in the weights' header are derived from them.

/// One input of a network.
#[derive(Clone, Debug, PartialEq)]
pub struct Feature {
    /// Name, such as `goal_distance` or `path.3.ahead`.
    pub name: String,
    /// Unit of the value before scaling; empty for pure numbers, `flag` for 0 or 1.
    pub unit: &'static str,
    /// Divisor of the value.
    pub scale: f64,
    /// Meaning of the value.
    pub meaning: &'static str,
}

/// A fixed row of inputs.
pub trait Block {
    /// Number of inputs of the row.
    const WIDTH: usize;

    /// Appends all inputs in order; their names begin with `prefix`.
    fn describe(prefix: &str, out: &mut Vec<Feature>);

    /// Appends all values in the same order, scaled.
    fn write(&self, out: &mut Writer<'_>);
}

/// Bound of scaled inputs, so that a far goal or an outlier in a log does not dominate all others.
const BOUND: f64 = 20.0;

/// Fills an array from the left.
pub struct Writer<'a> {
    values: &'a mut [f32],
    at: usize,
}

impl Writer<'_> {
    /// Writes the next value, scaled and clamped; a value that is not finite becomes zero.
    pub fn push(&mut self, value: f64, scale: f64) {
        let scaled = value / scale;
        if let Some(slot) = self.values.get_mut(self.at) {
            *slot = if scaled.is_finite() { scaled.clamp(-BOUND, BOUND) as f32 } else { 0.0 };
        }
        self.at += 1;
    }
}

/// The row in the form of the networks. An array of another width does not compile.
pub fn encoded<B: Block, const N: usize>(block: &B) -> [f32; N] {
    const { assert!(N == B::WIDTH, "the array is as wide as the block") };
    let mut values = [0.0; N];
    let mut writer = Writer { values: &mut values, at: 0 };
    block.write(&mut writer);
    debug_assert_eq!(writer.at, N, "every input is written once");
    values
}

/// All inputs of a block in their order.
pub fn described<B: Block>() -> Vec<Feature> {
    let mut out = Vec::with_capacity(B::WIDTH);
    B::describe("", &mut out);
    out
}

/// A flag as a number.
pub fn flag(value: bool) -> f64 {
    f64::from(u8::from(value))
}

/// Defines a block: a struct of `f64` fields and of other blocks, in the order of the networks' inputs. A
/// field is `name: (flag)`, `name: (SCALE "UNIT")`, one of these `; COUNT` times, or `[Block; COUNT]`, and
/// its meaning.
macro_rules! block {
    ($(#[$meta:meta])* pub struct $name:ident { $($field:ident: $spec:tt $meaning:literal,)* }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        // In this order and without gaps, because indices are offsets.
        #[repr(C)]
        pub struct $name { $(#[doc = $meaning] pub $field: block!(@type $spec),)* }

        impl $crate::features::block::Block for $name {
            const WIDTH: usize = 0 $(+ block!(@width $spec))*;

            fn describe(prefix: &str, out: &mut Vec<$crate::features::block::Feature>) {
                $(block!(@describe $spec, format!("{prefix}{}", stringify!($field)), $meaning, out);)*
            }

            fn write(&self, out: &mut $crate::features::block::Writer<'_>) {
                $(block!(@write $spec, self.$field, out);)*
            }
        }
    };
    (@type (flag)) => { f64 };
    (@type (flag; $count:expr)) => { [f64; $count] };
    (@type ($scale:literal $unit:literal)) => { f64 };
    (@type [$block:ty; $count:expr]) => { [$block; $count] };
    (@width (flag)) => { 1 };
    (@width (flag; $count:expr)) => { $count };
    (@width ($scale:literal $unit:literal)) => { 1 };
    (@width [$block:ty; $count:expr]) => { $count * <$block as $crate::features::block::Block>::WIDTH };
    (@feature $name:expr, $unit:expr, $scale:expr, $meaning:expr, $out:ident) => {
        $out.push($crate::features::block::Feature {
            name: $name, unit: $unit, scale: $scale, meaning: $meaning.trim_ascii(),
        })
    };
    (@describe (flag), $name:expr, $meaning:expr, $out:ident) => {
        block!(@feature $name, "flag", 1.0, $meaning, $out)
    };
    (@describe (flag; $count:expr), $name:expr, $meaning:expr, $out:ident) => {
        for i in 0..$count {
            block!(@feature format!("{}.{i}", $name), "flag", 1.0, $meaning, $out);
        }
    };
    (@describe ($scale:literal $unit:literal), $name:expr, $meaning:expr, $out:ident) => {
        block!(@feature $name, $unit, $scale, $meaning, $out)
    };
    (@describe [$block:ty; 1], $name:expr, $meaning:expr, $out:ident) => {
        <$block as $crate::features::block::Block>::describe(&format!("{}.", $name), $out)
    };
    (@describe [$block:ty; $count:expr], $name:expr, $meaning:expr, $out:ident) => {
        for i in 0..$count {
            <$block as $crate::features::block::Block>::describe(&format!("{}.{i}.", $name), $out);
        }
    };
    (@write (flag), $value:expr, $out:ident) => { $out.push($value, 1.0) };
    (@write (flag; $count:expr), $value:expr, $out:ident) => {
        for value in $value {
            $out.push(value, 1.0);
        }
    };
    (@write ($scale:literal $unit:literal), $value:expr, $out:ident) => { $out.push($value, $scale) };
    (@write [$block:ty; $count:expr], $value:expr, $out:ident) => {
        for block in &$value {
            $crate::features::block::Block::write(block, $out);
        }
    };
}

/// Index of a field's first number in its block.
macro_rules! index_of {
    ($block:ty, $field:ident) => {
        std::mem::offset_of!($block, $field) / std::mem::size_of::<f64>()
    };
}

pub(crate) use {block, index_of};

#[cfg(test)]
mod tests {
    use super::*;

    block! {
        /// A point.
        pub struct Point {
            ahead: (10.0 "m") "ahead",
            left: (5.0 "m") "left",
        }
    }

    block! {
        /// A row with every kind of field.
        pub struct Row {
            stands: (flag) "stands",
            path: [Point; 2] "two points",
            slot: (flag; 2) "which slot",
            pace: (2.0 "m/s") "pace",
        }
    }

    #[test]
    fn a_row_is_written_and_described_in_one_order() {
        let row = Row {
            stands: flag(true),
            path: [Point { ahead: 5.0, left: 1.0 }, Point { ahead: f64::NAN, left: -1e9 }],
            slot: [0.0, 1.0],
            pace: 3.0,
        };
        assert_eq!(encoded::<Row, 8>(&row), [1.0, 0.5, 0.2, 0.0, -20.0, 0.0, 1.0, 1.5]);
        let names: Vec<String> = described::<Row>().into_iter().map(|f| f.name).collect();
        let expected = [
            "stands",
            "path.0.ahead",
            "path.0.left",
            "path.1.ahead",
            "path.1.left",
            "slot.0",
            "slot.1",
            "pace",
        ];
        assert_eq!(names, expected);
        assert_eq!((index_of!(Row, path), index_of!(Row, slot), index_of!(Row, pace)), (1, 5, 7));
        assert_eq!(described::<Row>()[7].unit, "m/s");
    }
}
