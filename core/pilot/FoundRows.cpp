#include "core/pilot/FoundRows.h"

#include <cmath>

#include "core/analysis/statistics/StatisticsJson.h"
#include "core/base/RecordFields.h"

namespace tacto {

namespace {

using nlohmann::json;

RecordFields<PlanRow> buildPlanFields() {
    using P = PlanRow;
    RecordFields<P> all;
    all.number("seed", &P::seed);
    all.text("encoding", &P::encoding, {.mayBeEmpty = true});
    all.number("blocks", &P::blocks);
    all.texts({{"run_sha256", &P::runSha256}, {"answers", &P::answers}}, {.mayBeEmpty = true});
    return all;
}
const RecordFields<PlanRow>& planFields() {
    static const auto fields = buildPlanFields();
    return fields;
}

/// A text, or null for none.
ValueKind<std::string> textOrNullKind() {
    return codedKind<std::string>(
        "a text or null",
        [](const json& value) { return std::optional(value.is_string() ? value.get<std::string>() : ""); },
        [](const std::string& text) { return text.empty() ? json() : json(text); });
}

RecordFields<RangeRow> rangeFields(LevelUnit unit) {
    using R = RangeRow;
    RecordFields<R> all;
    all.flag("usable", &R::usable);
    all.add("reason", &R::reason, textOrNullKind());
    all.number(levelKey("min", unit), &R::min);
    all.number(levelKey("max", unit), &R::max);
    all.number("jnd", &R::jnd);
    all.word("limited_by", &R::limitedBy, kLevelLimits);
    if (unit == LevelUnit::Intensity) return all;
    all.number("min_v", &R::minVoltage);
    all.number("max_v", &R::maxVoltage);
    all.number("impedance_ohm", &R::impedance);
    return all;
}

RecordFields<DriftRow> driftFields(LevelUnit unit) {
    using D = DriftRow;
    RecordFields<D> all;
    all.number("block", &D::block);
    all.add(levelKey("detection", unit), &D::detection,
            codedKind<Estimate>(
                "an estimate or null", [](const json& value) { return std::optional(estimateFrom(value)); },
                [](const Estimate& estimate) { return estimateOrNull(estimate); }));
    all.number("probability", &D::probability);
    all.number("rests", &D::rests);
    all.flag("adapted", &D::adapted);
    return all;
}

/// The unit of a row that has this level.
LevelUnit unitIn(const json& body, std::string_view level) {
    return body.contains(levelKey(level, LevelUnit::Intensity)) ? LevelUnit::Intensity : LevelUnit::Current;
}

/// Into a new record; what cannot be read is passed over.
template <class Row>
Row rowFrom(const RecordFields<Row>& fields, const json& body, Row row = {}) {
    static_cast<void>(fields.read(body, row, {.lenient = true}));
    return row;
}

}  // namespace

json estimateOrNull(const Estimate& estimate) { return std::isfinite(estimate.value) ? toJson(estimate) : json(); }

Estimate estimateFrom(const json& value) {
    return {numberOr(value, "value"), numberOr(value, "low"), numberOr(value, "high")};
}

json toJson(const PlanRow& row) { return planFields().write(row); }

PlanRow planRowFrom(const json& body) { return rowFrom(planFields(), body); }

json toJson(const RangeRow& row) { return rangeFields(row.unit).write(row); }

RangeRow rangeRowFrom(const json& body) {
    const auto unit = unitIn(body, "min");
    return rowFrom(rangeFields(unit), body, {.unit = unit});
}

json toJson(const DriftRow& row) { return driftFields(row.unit).write(row); }

DriftRow driftRowFrom(const json& body) {
    const auto unit = unitIn(body, "detection");
    return rowFrom(driftFields(unit), body, {.unit = unit});
}

}  // namespace tacto
