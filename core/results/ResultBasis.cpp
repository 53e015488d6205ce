#include "core/results/ResultBasis.h"

#include "core/results/ResultRecord.h"

namespace tacto {

using namespace describe;

namespace {

ResultRecord<ReferenceCheck> describeReferenceCheck() {
    using R = ReferenceCheck;
    ResultRecord<R> all;
    all.shown(number("Deviation", "deviation_pct", "%", "expanded_uncertainty_pct"), &R::deviation_pct);
    all.kept("expanded_uncertainty_pct", &R::expanded_pct);
    all.shown(number("Allowed, ±", "allowed_pct", "%"), &R::allowed_pct);
    all.shown(verdict(), &R::verdict);
    all.kept("passed", &R::passed);
    return all;
}

ResultRecord<KnownLoadCheck> describeKnownLoad() {
    using K = KnownLoadCheck;
    ResultRecord<K> all;
    all.shown(number("Known load", "load_ohm", "ohm"), &K::load_ohm);
    all.shown(number("Read as", "measured_ohm", "ohm", "expanded_ohm"), &K::measured_ohm);
    all.kept("expanded_ohm", &K::expanded_ohm);
    all.mergeShown(std::identity(), referenceCheckRecord());
    all.shown(text("Reason", "reason"), nullIfEmpty(&K::reason));
    return all;
}

ResultRecord<AbsoluteCheck> describeAbsolute() {
    using A = AbsoluteCheck;
    ResultRecord<A> all;
    all.kept("reference_v", &A::reference_v);
    all.kept("reference_u_pct", &A::reference_u_pct);
    all.kept("measured_v", &A::measured_v);
    all.kept("expanded_v", &A::expanded_v);
    all.mergeShown(std::identity(), referenceCheckRecord());
    all.shown(text("It read", "text"), &A::text);
    return all;
}

ResultRecord<ChannelSeen> describeChannel() {
    using C = ChannelSeen;
    ResultRecord<C> all;
    all.shown(text("Channel", "channel"), &C::name);
    all.kept("unit", &C::unit);
    all.shown(tolerance("Gain, ±", "gain_pct", "%"), &C::gain_pct);
    all.kept("offset", &C::offset);
    all.kept("lsb", &C::lsb);
    all.shown(tolerance("Probe, ±", "probe_pct", "%"), &C::probe_pct);
    all.kept("linearity", &C::linearity);
    all.shown(tolerance("Time base, ±", "timebase_ppm", "ppm"), &C::timeBase_ppm);
    all.kept("stamp_s", &C::stamp_s);
    all.shown(text("As stated by", "stated_by"), &C::statedBy);
    return all;
}

ResultRecord<InstrumentSeen> describeInstrument() {
    using I = InstrumentSeen;
    ResultRecord<I> all;
    all.shown(text("Role", "role"), &I::role);
    all.shown(text("Instrument", "name"), &I::name);
    all.shown(text("Serial", "serial"), &I::serial);
    all.shown(as(As::YesNo, "Simulated", "simulated"), &I::simulated);
    all.merge(&I::channel, describeChannel());
    return all;
}

}  // namespace

const ResultRecord<ReferenceCheck>& referenceCheckRecord() { return builtOnce<describeReferenceCheck>(); }

nlohmann::json toJson(const KnownLoadCheck& check) { return builtOnce<describeKnownLoad>().write(check); }

nlohmann::json knownLoadTable(const KnownLoadCheck& check) {
    const auto record = toJson(check);
    auto row = nlohmann::json::object(), order = nlohmann::json::array();
    for (const auto& column : builtOnce<describeKnownLoad>().columns()) {
        if (column.at == "reason") continue;
        auto cell = record[column.at];
        if (!column.unit.empty()) cell = {{"value", std::move(cell)}, {"unit", column.unit}};
        if (!column.beside.empty()) cell["expanded"] = record[column.beside];
        const auto& key = column.as == ResultColumn::As::Verdict ? column.at : column.title;
        row[key] = std::move(cell);
        order.push_back(key);
    }
    return {{"kind", "table"},
            {"caption", "Known-reference check"},
            {"rows", nlohmann::json::array({row})},
            {"columns", std::move(order)}};
}

std::vector<std::string> knownLoadMembers() { return builtOnce<describeKnownLoad>().keys(); }

nlohmann::json toJson(const AbsoluteCheck& check) { return builtOnce<describeAbsolute>().write(check); }

std::vector<std::string> absoluteMembers() { return builtOnce<describeAbsolute>().keys(); }

nlohmann::json toJson(const InstrumentSeen& instrument) { return builtOnce<describeInstrument>().write(instrument); }

Columns instrumentColumns() { return describeInstrument().columns(); }

namespace describe {

Tables withBasis(Tables tables) {
    tables.push_back(facts("Known reference", "reference", describeKnownLoad().columns(), Else::InTheReport));
    tables.push_back(facts("Absolute reference", "absolute", describeAbsolute().columns(), Else::InTheReport));
    auto columns = instrumentColumns();
    columns.pop_back();  // who is simulated is said above the results
    for (const auto& column : describeChannel().columns()) columns.push_back(column);
    tables.push_back(rows("Instruments", "instruments", std::move(columns), Else::InBoth));
    tables.push_back(sentences("What it rests on", "rests_on", Else::InBoth));
    return tables;
}

}  // namespace describe

}  // namespace tacto
