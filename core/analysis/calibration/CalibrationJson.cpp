#include "core/analysis/calibration/CalibrationJson.h"

#include <cmath>
#include <limits>

#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/Csv.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/Statistics.h"
#include "core/encoding/StimulatorCalibration.h"
#include "core/results/ResultRecord.h"

namespace tacto {

using nlohmann::json;

namespace {

using namespace describe;

ResultRecord<CalibrationLevel> describeLevel() {
    using L = CalibrationLevel;
    ResultRecord<L> all;
    all.shown(number("Commanded", "commanded", "@unit"), &L::commanded);
    all.shown(number("n", "n"), &L::n);
    all.kept("not_measured", &L::notMeasured);
    all.kept("mean", &L::mean);
    all.kept("mean_up", &L::meanUp);
    all.kept("mean_down", &L::meanDown);
    all.shown(spread("s", "s", "@unit"), &L::s);
    all.kept("residual", &L::residual);
    return all;
}

ResultRecord<CalibrationReading> describeReading() {
    using R = CalibrationReading;
    ResultRecord<R> all;
    all.shown(number("Commanded", "commanded", "@unit"), &R::commanded);
    all.shown(number("Measured", "measured", "@unit"), &R::measured);
    all.shown(text("Direction", "direction"), &R::direction);
    all.kept("outlier", &R::outlier);
    return all;
}

ResultRecord<Calibration> describeCalibration() {
    using C = Calibration;
    ResultRecord<C> all;
    all.kept("gain", &C::gain);
    all.kept("offset", &C::offset);
    all.kept("gain_standard_error", &C::gainStandardError);
    all.kept("offset_standard_error", &C::offsetStandardError);
    all.kept("weighted", &C::weighted);
    all.kept("full_scale", &C::fullScale);
    all.shown(spread("Repeatability", "repeatability_pct_fs", "% FS"), &C::repeatability_pct);
    all.shown(spread("Hysteresis", "hysteresis_pct_fs", "% FS"), &C::hysteresis_pct);
    all.shown(spread("Largest residual", "residual_max_pct_fs", "% FS"), &C::residualMax_pct);
    all.shown(number("Readings", "n"), [](const C& found) { return found.readings.size() - found.notMeasured; });
    all.shown(number("Standing out, marked and kept", "outliers"), &C::outliers);
    all.kept("not_measured", &C::notMeasured);
    all.kept("complete", &C::complete);
    all.kept("levels", &C::levels, describeLevel());
    all.kept("readings", &C::readings, describeReading());
    all.kept("warnings", &C::warnings);
    return all;
}

ResultRecord<Contribution> describeContribution() {
    using C = Contribution;
    ResultRecord<C> all;
    all.shown(text("Contribution", "name"), &C::name);
    all.shown(text("Distribution", "distribution"), &C::distribution);
    all.kept("value", &C::value);
    all.kept("divisor", &C::divisor);
    all.kept("sensitivity", &C::sensitivity);
    all.shown(number("u", "contribution", "@unit"), &C::contribution);
    all.shown(as(As::Freedom, "Degrees of freedom", "degrees_of_freedom"), &C::degreesOfFreedom);
    return all;
}

ResultRecord<UncertaintyBudget> describeBudget() {
    using B = UncertaintyBudget;
    ResultRecord<B> all;
    all.kept("rows", &B::rows, describeContribution());
    all.kept("degrees_of_freedom", &B::degreesOfFreedom);
    all.shown(as(As::Quantity, "Quantity", "quantity"));  // the quantity that the budget belongs to
    all.shown(number("Combined, u", "combined", "@unit"), &B::combined);
    all.shown(number("Expanded, U (95 %)", "expanded_uncertainty", "@unit"), &B::expanded);
    all.shown(number("k", "coverage_factor"), &B::coverageFactor);
    all.shown(text("Method", "method"), &B::method);
    return all;
}

/// A level with its judgement.
struct LevelAsJudged {
    CalibrationLevel level;
    JudgedLevel judged;
};

ResultRecord<LevelAsJudged> describeJudgedLevel() {
    using L = LevelAsJudged;
    using J = JudgedLevel;
    using B = UncertaintyBudget;
    const auto worst = in(&L::judged, &J::worstBudget);
    const auto level = describeLevel();
    ResultRecord<L> all;
    all.merge(&L::level, level);
    all.shown(verdict(), in(&L::judged, &J::verdict));
    all.shown(level.column("commanded", "Commanded"));
    all.shown(level.column("n", "n"));
    all.shown(number("Error, going up", "mean_up-commanded", "@unit"));
    all.shown(number("Error, going down", "mean_down-commanded", "@unit"));
    all.shown(level.column("s", "s"));
    all.kept("error", in(&L::judged, &J::error));
    all.kept("expanded_uncertainty", in(in(&L::judged, &J::budget), &B::expanded));
    all.shown(number("Error judged", "worst_error", "@unit", "worst_expanded_uncertainty"),
              in(&L::judged, &J::worstError));
    all.kept("worst_expanded_uncertainty", in(worst, &B::expanded));
    all.shown(number("k", "worst_coverage_factor"), in(worst, &B::coverageFactor));
    all.shown(number("Tolerance, ±", "tolerance", "@unit"), in(&L::judged, &J::tolerance));
    all.shown({"Used", "worst_error", As::Used, "@tolerance", "worst_expanded_uncertainty"});
    return all;
}

std::vector<LevelAsJudged> judgedLevels(const JudgedCalibration& judged) {
    std::vector<LevelAsJudged> all;
    for (std::size_t k = 0; k < judged.levels.size(); ++k)
        all.push_back({judged.calibration.levels[k], judged.levels[k]});
    return all;
}

ResultRecord<JudgedCalibration> describeJudged() {
    using J = JudgedCalibration;
    using B = UncertaintyBudget;
    const auto found = describeCalibration();
    const auto top = [](const J& judged) -> const B& { return judged.fullScale().budget; };
    ResultRecord<J> all;
    all.merge(&J::calibration, found);
    all.shown(verdict());
    all.shown(as(As::Quantity, "Quantity", "quantity"));
    all.shown(number("Gain", "gain", "", "gain_expanded_uncertainty"));
    all.kept("gain_expanded_uncertainty", in(&J::gain, &B::expanded));
    all.shown(number("k", "gain_coverage_factor"), in(&J::gain, &B::coverageFactor));
    all.shown(number("Offset", "offset", "@unit", "offset_expanded_uncertainty"));
    all.kept("offset_expanded_uncertainty", in(&J::offset, &B::expanded));
    all.shown(number("k", "offset_coverage_factor"), in(&J::offset, &B::coverageFactor));
    for (const auto& [key, title] :
         {std::pair("residual_max_pct_fs", "Residual"), std::pair("repeatability_pct_fs", "Repeatability"),
          std::pair("hysteresis_pct_fs", "Hysteresis")}) {
        auto column = found.column(key, title);
        column.unit = "%";
        all.shown(std::move(column));
    }
    all.kept("levels", judgedLevels, describeJudgedLevel());
    all.kept("expanded_uncertainty", [top](const J& judged) { return top(judged).expanded; });
    all.kept("budget", top, describeBudget());
    all.kept(
        "budget_smallest", [](const J& judged) -> const B& { return judged.smallest().budget; }, describeBudget());
    all.kept("tolerance_pct", &J::tolerance_pct);
    all.judged();
    return all;
}

const ResultRecord<JudgedCalibration>& judgedRecord() { return builtOnce<describeJudged>(); }

ResultRecord<CheckedLevel> describeChecked() {
    using C = CheckedLevel;
    ResultRecord<C> all;
    all.shown(verdict(), &C::verdict);
    all.shown(as(As::Quantity, "Quantity", "quantity"), &C::quantity);
    all.shown(number("Commanded", "commanded", "@unit"), &C::commanded);
    all.shown(number("Expected", "expected", "@unit"), &C::expected);
    all.shown(number("Measured", "measured", "@unit"), &C::measured);
    all.shown(number("Off", "off", "@unit", "expanded_uncertainty"), &C::off);
    all.kept("expanded_uncertainty", &C::expanded);
    all.shown(text("Direction", "direction"), &C::direction);
    all.shown(number("Allowed, ±", "allowed", "@unit"), &C::allowed);
    all.kept("not_measured", &C::notMeasured);
    all.kept("unit", &C::unit);
    return all;
}

ResultRecord<CalibrationCheck> describeCheck() {
    ResultRecord<CalibrationCheck> all;
    all.kept("rows", &CalibrationCheck::rows, describeChecked());
    all.judged();
    return all;
}

ResultRecord<KeptCalibration> describeKept() {
    using K = KeptCalibration;
    ResultRecord<K> all;
    all.shown(text("Stimulator", "serial"), &K::serial);
    all.shown(text("Valid until", "valid_until"), &K::validUntil);
    all.kept("supersedes", nullIfEmpty(&K::supersedes));
    all.shown(number("Readings", "readings"), &K::readings);
    all.kept("session_head", &K::sessionHead);
    all.shown(as(As::YesNo, "Simulated", "simulated"), &K::simulated);
    return all;
}

/// Paths of this member of every quantity: "amplitude.budget|interval.budget|...".
std::string ofEach(std::string_view member) {
    std::string all;
    for (const auto& one : kCalibratedQuantities) {
        if (!all.empty()) all += '|';
        all.append(one.id).append(member);
    }
    return all;
}

/// Adds tables of the levels, of the uncertainty budgets at both ends (which may differ), and of marked readings.
void addQuantity(Tables& all, const std::string& title, const std::string& id) {
    const auto add = [&](const char* what, const char* at, Columns columns) -> ResultTable& {
        return all.emplace_back(
            rows((title + what).c_str(), (id + at).c_str(), std::move(columns), Else::InTheTerminal));
    };
    add(": levels", ".levels", builtOnce<describeJudgedLevel>().columns()).note =
        "The error that is judged is that of the worse direction, with its U (95 %).";
    const auto contributions = describeContribution().columns();
    add(": uncertainty at the largest command", ".budget.rows", contributions);
    add(": uncertainty at the smallest command", ".budget_smallest.rows", contributions).shown = Else::OnlyInTheReport;
    auto& marked = add(": readings that stand out, marked and kept", ".readings", describeReading().columns());
    marked = whose(std::move(marked), "outlier", true);
}

/// Tables for all places of the quantities: members in a protocol, a check of a stored calibration, and a stored one.
Tables stimulatorTables() {
    const auto found = describeCalibration();
    const auto of = ofEach("");
    Tables all{rows("What was found: gain and offset ± U (95 %), the rest in % of the largest command", of.c_str(),
                    judgedRecord().columns()),
               rows("Readings", of.c_str(),
                    {as(As::Quantity, "Quantity", "quantity"), found.column("n", "Measured"),
                     number("Not measured", "not_measured"), found.column("outliers", "Stand out, marked and kept")},
                    Else::InTheTerminal),
               rows("Uncertainty at the largest command", ofEach(".budget").c_str(), describeBudget().columns(),
                    Else::InTheTerminal),
               rows("Uncertainty at the smallest command", ofEach(".budget_smallest").c_str(),
                    describeBudget().columns(), Else::InTheTerminal)};
    for (const auto& one : kCalibratedQuantities) addQuantity(all, std::string(one.title), std::string(one.id));
    all.push_back(rows("Check of the stored calibration", "check", describeChecked().columns()));
    all.push_back(facts("Stored calibration", "stored", describeKept().columns()));
    return all;
}

}  // namespace

json toJson(const Calibration& found) { return builtOnce<describeCalibration>().write(found); }

json toJson(const UncertaintyBudget& budget) { return builtOnce<describeBudget>().write(budget); }

json toJson(const JudgedCalibration& judged) { return judgedRecord().write(judged); }

json toJson(const CalibrationCheck& check) { return builtOnce<describeCheck>().write(check); }

json toJson(const KeptCalibration& kept) { return builtOnce<describeKept>().write(kept); }

std::vector<std::string> keptMembers() { return builtOnce<describeKept>().keys(); }

ResultTraits stimulatorCalibrationKind() {
    return {.kind = ResultKind::StimulatorCalibration,
            .name = "stimulator-calibration",
            .decisionRule =
                "Each level passes when |error| + U is within the tolerance, fails when |error| − U is not, and is "
                "indeterminate between; the worse sweep direction is judged. The verdict is the worst level's.",
            .guardBanded = true,
            .tables = withBasis(stimulatorTables())};
}

std::vector<std::string> judgedMembers() { return judgedRecord().keys(); }

const ResultRecord<Calibration>& calibrationRecord() { return builtOnce<describeCalibration>(); }

namespace {

/// A finite number, or NaN if `mayLack` and the field is empty or "nan".
Result<double> numberIn(const NamedRows& rows, std::size_t index, std::string_view column, bool mayLack, double least) {
    const auto field = rows[index];
    if (field.empty() && mayLack) return kNaN;
    const auto number = parseNumber(field);
    if (number && ((std::isfinite(*number) && *number >= least) || (std::isnan(*number) && mayLack))) return *number;
    return rows.refuse("{} '{}'; a finite number{} was expected{}", column, field.substr(0, 40),
                       std::isfinite(least) ? " of 0 or more" : "", mayLack ? ", or nothing" : "");
}

Result<SweepDirection> directionIn(const NamedRows& rows, std::size_t index) {
    const auto field = rows[index];
    if (const auto known = valueFor(kSweepDirections, field)) return *known;
    return rows.refuse("direction '{}'; up, down or nothing was expected", field.substr(0, 40));
}

}  // namespace

Result<std::vector<CalibrationReading>> readCalibrationReadings(const std::filesystem::path& path) {
    const auto text = readTextFile(path);
    if (!text) return failure(text);
    return parseCalibrationReadings(*text, path.string());
}

Result<std::vector<CalibrationReading>> parseCalibrationReadings(std::string_view text, std::string_view name) {
    constexpr double kAny = -std::numeric_limits<double>::infinity();
    NamedRows rows(text, name, "columns commanded and measured, and perhaps direction and u, were expected",
                   "a row per reading");
    const auto commanded = rows.column({"commanded"});
    if (!commanded) return failure(commanded);
    const auto measured = rows.column({"measured"});
    if (!measured) return failure(measured);
    const auto direction = rows.find({"direction"});
    const auto uncertainty = rows.find({"u"});

    std::vector<CalibrationReading> readings;
    auto more = rows.next();
    for (; more && *more; more = rows.next()) {
        CalibrationReading reading;
        const auto command = numberIn(rows, *commanded, "commanded", false, kAny);
        if (!command) return failure(command);
        reading.commanded = *command;
        const auto value = numberIn(rows, *measured, "measured", true, kAny);
        if (!value) return failure(value);
        reading.measured = *value;
        if (direction) {
            const auto turned = directionIn(rows, *direction);
            if (!turned) return failure(turned);
            reading.direction = *turned;
        }
        if (uncertainty) {
            const auto u = numberIn(rows, *uncertainty, "u", true, 0);
            if (!u) return failure(u);
            reading.uncertainty = *u;
        }
        readings.push_back(reading);
    }
    if (!more) return failure(more);
    return readings;
}

}  // namespace tacto
