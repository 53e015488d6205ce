// Results of runs that judge nothing: what was delivered; and of sessions with a participant, whose reports are the
// study's.
#include "core/results/Describe.h"

namespace tacto::describe {

namespace {

ResultTraits recording(ResultKind kind, std::string_view name, Columns delivered) {
    Columns columns{number("Duration", "duration_s", "s")};
    columns.insert(columns.end(), delivered.begin(), delivered.end());
    columns.push_back(number("Trains skipped", "trains_skipped"));
    columns.push_back(number("Samples lost", "samples_lost"));
    columns.push_back(number("Gaps in the recording", "gaps"));
    return {.kind = kind,
            .name = name,
            .decisionRule = "A recording: nothing is judged.",
            .tables = {facts("Totals", "", std::move(columns))}};
}

/// Of whom a session is, and the thresholds and range that were found: levels of current, or a massager's strengths.
Tables ofSession(const char* thresholds) {
    return {
        facts("Session", "",
              {text("Participant", "participant.code"), text("Basis", "participant.basis"), number("Parts", "parts")},
              Else::InTheReport),
        facts("Thresholds and range", thresholds,
              {number("Felt from", "felt_ma", "mA"),
               number("Felt from", "felt_intensity"),
               number("Too strong from", "too_strong_ma", "mA"),
               number("Too strong from", "too_strong_intensity"),
               as(As::YesNo, "Said to be too strong, not only the highest", "said_too_strong"),
               number("Detection", "detection.estimate_ma", "mA"),
               number("Detection", "detection.estimate_intensity"),
               as(As::YesNo, "It may lie beyond", "detection.at_edge"),
               number("Trials", "detection.trials"),
               as(As::Condition, "By", "detection.method"),
               as(As::YesNo, "The range is usable", "range.usable"),
               text("Why not", "range.reason"),
               number("Range, from", "range.min_ma", "mA"),
               number("to", "range.max_ma", "mA"),
               number("Range, from", "range.min_intensity"),
               number("to", "range.max_intensity"),
               number("Voltage, from", "range.min_v", "V"),
               number("to", "range.max_v", "V"),
               number("at", "range.impedance_ohm", "ohm"),
               jnd("Width (JND)", "range.jnd"),
               as(As::Condition, "Limited by", "range.limited_by"),
               number("Weber fraction of strength", "comparison.amplitude_weber"),
               as(As::YesNo, "It may lie beyond", "comparison.at_edge")},
              Else::InTheReport)};
}

ResultTraits live() {
    return recording(ResultKind::Live, "live",
                     {number("Trains delivered", "trains_delivered"), number("Trains refused", "trains_refused")});
}

ResultTraits massager() {
    return recording(ResultKind::Massager, "massager", {number("Bursts delivered", "bursts_delivered")});
}

ResultTraits pilotThresholds() {
    Tables tables = ofSession("");
    tables.push_back(rows("Series", "series",
                          {number("Felt from", "felt_ma", "mA"), number("Felt from", "felt_intensity"),
                           number("Too strong from", "too_strong_ma", "mA"),
                           number("Too strong from", "too_strong_intensity"), number("Highest", "highest_ma", "mA"),
                           number("Highest", "highest_intensity"), as(As::Condition, "Ended by", "ended_by")},
                          Else::InTheReport));
    return {
        .kind = ResultKind::PilotThresholds, .name = "pilot-thresholds", .ofStudy = true, .tables = std::move(tables)};
}

ResultTraits pilotIdentification() {
    Tables tables = ofSession("thresholds");
    for (auto& table : Tables{
             rows("Presented", "presented",
                  {as(As::Condition, "Condition", "name"), number("Level", "current_ma", "mA"),
                   number("Strength", "intensity"), number("Interval", "interval_s", "s")}),
             confusion("Given, and answered"),
             rows("Told apart", "|texture|pressure",
                  {text("Of", "of"), number("Right", "hits"), number("n", "n"), as(As::Share, "Share", "accuracy"),
                   as(As::Chance, "By chance, p", "p_chance"),
                   number("Corrected information", "it_corrected_bits", "bit"),
                   number("95 % from", "it_corrected_low_bits", "bit"), number("to", "it_corrected_high_bits", "bit")}),
             facts("Catch trials", "",
                   {number("Nothing was given", "catch.n"), number("It was named as something", "catch.false_alarms"),
                    number("No answer, in all trials", "no_answer")}),
             rows("What the massager did", "vibration.conditions",
                  {as(As::Condition, "Condition", "name"), number("Strength", "intensity"),
                   number("Acceleration, mean and s.d.", "strength_m_s2", "m/s2"),
                   number("Interval, mean and s.d.", "measured_interval_s", "s"), number("Moved", "moved"),
                   number("Missed", "missed")}),
             facts("Of the massager", "vibration", {as(As::YesNo, "What it did was measured", "measured"), verdict()}),
             sentences("Notes", "notes")}) {
        table.shown = Else::InTheReport;
        tables.push_back(std::move(table));
    }
    return {.kind = ResultKind::PilotIdentification,
            .name = "pilot-identification",
            .ofStudy = true,
            .tables = std::move(tables)};
}

}  // namespace

Kinds recordingKinds() { return {live(), massager(), pilotThresholds(), pilotIdentification()}; }

}  // namespace tacto::describe
