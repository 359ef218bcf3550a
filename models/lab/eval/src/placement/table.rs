//! The table as Markdown.

use super::{DistributionDistance, Interval, PlacementFacts, PlacementReport};
use std::fmt::Write as _;

/// The report as Markdown, the same bytes for the same report.
pub fn markdown(report: &PlacementReport) -> String {
    let mut text = String::new();
    let logged: Vec<String> =
        report.logged.iter().map(|(t, n)| format!("{n} {}", format!("{t:?}").to_lowercase())).collect();
    let _ = writeln!(
        text,
        "{} scenes, {} placements each, within {} m of the ego; logged: {}. Wasserstein-1 distance from the \
         log [95 % over scenes] (Jensen-Shannon divergence, bits); smaller is nearer.\n",
        report.scenes,
        report.seeds,
        report.radius_m,
        logged.join(", ")
    );
    text.push_str("| type | measure | model | lane sampler | log halves |\n|---|---|---|---|---|\n");
    for (agent_type, rows) in &report.rows {
        for (measure, row) in rows {
            let _ = writeln!(
                text,
                "| {} | {} | {} | {} | {:.2} ({:.3}) |",
                format!("{agent_type:?}").to_lowercase(),
                measure.words(),
                gap(&row.model),
                gap(&row.lane_sampler),
                row.log_halves.wasserstein.value,
                row.log_halves.jensen_shannon
            );
        }
    }
    text.push_str("\n| | log | model | lane sampler |\n|---|---|---|---|\n");
    let three = [&report.log, &report.model, &report.lane_sampler];
    let mut line = |what: &str, of: &dyn Fn(&PlacementFacts) -> String| {
        let _ = writeln!(text, "| {what} | {} | {} | {} |", of(three[0]), of(three[1]), of(three[2]));
    };
    line("placed of asked", &|f| format!("{} of {}", f.placed, f.asked));
    line("overlapping pairs", &|f| f.overlaps.to_string());
    line("vehicles with a corner off the road", &|f| percent(&f.off_road_share));
    line("vehicles over 2 m from a lane's centre", &|f| percent(&f.off_lane_share));
    line("vehicles that stand", &|f| percent(&f.standing_share));
    text
}

fn gap(gap: &DistributionDistance) -> String {
    let w = gap.wasserstein;
    format!("{:.2} [{:.2}, {:.2}] ({:.3})", w.value, w.low, w.high, gap.jensen_shannon)
}

fn percent(figure: &Interval) -> String {
    format!("{:.1} % [{:.1}, {:.1}]", 100.0 * figure.value, 100.0 * figure.low, 100.0 * figure.high)
}
