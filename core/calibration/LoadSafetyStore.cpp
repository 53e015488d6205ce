#include "core/calibration/LoadSafetyStore.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/base/LocaleFreeText.h"
#include "core/base/RecordFields.h"
#include "core/base/Words.h"

namespace tacto {

namespace {

constexpr Word<CheckVerdict> kCheckVerdicts[] = {
    {"begun", CheckVerdict::Begun},     {"pass", CheckVerdict::Pass},
    {"fail", CheckVerdict::Fail},       {"indeterminate", CheckVerdict::Indeterminate},
    {"stopped", CheckVerdict::Stopped}, {"none", CheckVerdict::None}};

Result<void> checkWhole(const LoadSafetyCheck& c) {
    const auto wants = [&](std::string_view what) {
        return invalid("a load-safety check of stimulator \"{}\" without {}; one was expected", c.serial, what);
    };
    if (c.serial.empty()) return wants("a serial number");
    if (!c.made.ok()) return wants("a day");
    if (!isSha256(c.scriptSha256)) return wants("the digest of its protocol");
    if (c.session.empty()) return wants("its session");
    if (c.verdict == CheckVerdict::Pass && !isSha256(c.sessionHead)) return wants("the chain head of its session");
    return {};
}

RecordFields<LoadSafetyCheck> buildCheckFields() {
    using C = LoadSafetyCheck;
    using R = TrainReach;
    constexpr AcceptedText kAnyText{.mayBeEmpty = true};
    RecordFields<LimitSetHash> set;
    set.text("id", &LimitSetHash::id).required = true;
    set.text("sha256", &LimitSetHash::sha256).required = true;
    set.passOverUnknownKeys();  // so that files of a later version can be read

    RecordFields<C> all;
    all.text("serial", &C::serial, kAnyText).required = true;
    all.text("device", &C::device, kAnyText).required = true;
    all.add("made", &C::made, dateKind()).required = true;
    all.word("verdict", &C::verdict, kCheckVerdicts).required = true;
    all.flag("simulated", &C::simulated).required = true;
    all.number("area_cm2", &C::area, {.low = 0, .openLow = true, .unit = "cm²"}).required = true;
    all.number("amplitude_v", in(&C::reach, &R::amplitude_v), {.low = 0, .unit = "V"}).required = true;
    all.number("interval_s", in(&C::reach, &R::interval_s), {.low = 0, .unit = "s"}).required = true;
    all.number("phase_us", in(&C::reach, &R::phase_us), {.low = 0, .unit = "µs"}).required = true;
    // Lines of earlier versions lack these, and satisfy no session.
    all.number("load_low_ohm", in(&C::reach, &R::lowest_ohm), {.low = 0, .openLow = true, .unit = "ohm"});
    all.number("load_high_ohm", in(&C::reach, &R::highest_ohm), {.low = 0, .openLow = true, .unit = "ohm"});
    all.number("load_tolerance_pct", in(&C::tolerances, &CheckTolerances::load_pct), {.low = 0, .unit = "%"});
    all.number("amplitude_tolerance_pct", in(&C::tolerances, &CheckTolerances::amplitude_pct), {.low = 0, .unit = "%"});
    all.list("limits", &C::limits, set.kind(), 0, 100).required = true;
    all.text("script_sha256", &C::scriptSha256, kAnyText).required = true;
    all.text("session", &C::session, kAnyText).required = true;
    all.text("session_head", &C::sessionHead, kAnyText).required = true;
    all.passOverUnknownKeys();
    all.rule([](const C& one) { return checkWhole(one); });
    return all;
}

const RecordFields<LoadSafetyCheck>& checkFields() { return builtOnce<buildCheckFields>(); }

/// Returns an empty text if the worst case covered all loads of the session.
std::string loadsLeftOut(const TrainReach& made, const TrainReach& wanted) {
    if (!made.lowest_ohm || !made.highest_ohm)
        return "does not say for which loads its worst case was judged; a new one is expected";
    if (wanted.lowest_ohm && wanted.highest_ohm && *made.lowest_ohm <= *wanted.lowest_ohm &&
        *made.highest_ohm >= *wanted.highest_ohm)
        return {};
    return fmt::format(
        "was judged for loads of {:g} to {:g} Ω, and the session's profile permits {:g} to {:g} Ω; all of "
        "them are expected",
        *made.lowest_ohm, *made.highest_ohm, wanted.lowest_ohm.value_or(0), wanted.highest_ohm.value_or(HUGE_VAL));
}

/// Returns what a pass that is still in time lacks for `need`; empty: nothing.
std::string shortOf(const LoadSafetyCheck& found, const LoadSafetyNeed& need) {
    if (found.scriptSha256 != need.scriptSha256)
        return "was made by another version of the protocol; a check by this program's is expected";
    if (!found.area)
        return fmt::format("states no electrode area; one of at most {:g} cm² is expected", need.area.value());
    if (!(found.area->value() <= need.area.value())) {
        return fmt::format(
            "is of electrodes of {:g} cm², and those of the study have {:g} cm²; that or less is "
            "expected",
            found.area->value(), need.area.value());
    }
    constexpr double kRounding = 1e-9;
    const auto& made = found.reach;
    const auto& wanted = need.reach;
    if (!(made.amplitude_v >= wanted.amplitude_v - kRounding)) {
        return fmt::format("went up to {:g} V, and the session's profile to {:g} V; that or more is expected",
                           made.amplitude_v, wanted.amplitude_v);
    }
    if (!(made.interval_s <= wanted.interval_s + kRounding)) {
        return fmt::format("had trains every {:g} s, and the session has them every {:g} s; that or less is expected",
                           made.interval_s, wanted.interval_s);
    }
    if (!(made.phase_us >= wanted.phase_us - kRounding)) {
        return fmt::format(
            "had {:g} µs of each phase in a train, and the study's trains have {:g} µs; that or more is "
            "expected",
            made.phase_us, wanted.phase_us);
    }
    if (auto open = loadsLeftOut(made, wanted); !open.empty()) return open;
    if (auto wide = widerThan(found.tolerances, need.tolerances); !wide.empty()) return wide;
    for (const auto& set : need.limits) {
        if (std::ranges::find(found.limits, set) != found.limits.end()) continue;
        return fmt::format("was not judged by the limit set {} ({:.12}…) of the approval; a check by it is expected",
                           set.id, set.sha256);
    }
    return {};
}

}  // namespace

std::string widerThan(const CheckTolerances& allowed, const CheckTolerances& widest) {
    for (const auto& [its, most, what] :
         {std::tuple(allowed.load_pct, widest.load_pct, "a load's value"),
          std::tuple(allowed.amplitude_pct, widest.amplitude_pct, "an amplitude over the command")}) {
        if (!its) return fmt::format("does not say how much it allows for {}; a new one is expected", what);
        if (!(*its <= most.value_or(0)))
            return fmt::format("allows {:g} % for {}; at most {:g} % is expected", *its, what, most.value_or(0));
    }
    return {};
}

std::string_view nameOf(CheckVerdict verdict) noexcept { return wordFor(kCheckVerdicts, verdict); }

CheckVerdict checkVerdictFrom(std::string_view text) noexcept {
    return valueFor(kCheckVerdicts, text).value_or(CheckVerdict::None);
}

Result<LoadSafetyStore> LoadSafetyStore::open(std::filesystem::path file) {
    LoadSafetyStore store(std::move(file));
    if (auto done = store.read(); !done) return failure(done);
    return store;
}

Result<void> LoadSafetyStore::read() {
    all_.clear();
    return lines_.read([this](const nlohmann::json& line) -> Result<void> {
        auto made = checkFields().read(line.value("check", nlohmann::json()), RecordPlace{});
        if (!made) return failure(made);
        all_.push_back(std::move(*made));
        return {};
    });
}

Result<void> LoadSafetyStore::add(const LoadSafetyCheck& check) {
    if (auto whole = checkWhole(check); !whole) return whole;
    if (auto sound = checkFields().check(check, RecordPlace{}); !sound) return sound;
    const auto added = lines_.append([&]() -> Result<nlohmann::json> {
        if (auto done = read(); !done) return failure(done);  // another process may have added a line meanwhile
        return nlohmann::json{{"check", checkFields().write(check)}};
    });
    if (added) all_.push_back(check);
    return added;
}

const LoadSafetyCheck* LoadSafetyStore::latest(std::string_view serial) const {
    for (auto at = all_.rbegin(); at != all_.rend(); ++at) {
        if (at->serial == serial && !at->simulated) return &*at;
    }
    return nullptr;
}

Result<LoadSafetyCheck> LoadSafetyStore::passed(const LoadSafetyNeed& need) const {
    const auto refused = [&](const std::string& why) { return fail(ErrorCode::NotFound, "{}", why); };
    const auto wanted =
        fmt::format("one that passed at most {} days ago on the real bench is expected", kLoadSafetyHolds.count());
    if (need.serial.empty())
        return refused("the stimulator has no serial number by which its load-safety check could be found; " + wanted);
    const auto* found = latest(need.serial);
    if (found == nullptr) {
        const bool simulated = std::ranges::find(all_, need.serial, &LoadSafetyCheck::serial) != all_.end();
        return refused(fmt::format("stimulator {} has no load-safety check{}; {}", need.serial,
                                   simulated ? " but a simulated one" : "", wanted));
    }
    const auto of = fmt::format("the load-safety check of stimulator {} of {}", need.serial, dateText(found->made));
    if (found->verdict == CheckVerdict::Begun) return refused(of + " was begun and never ended; " + wanted);
    if (found->verdict != CheckVerdict::Pass)
        return refused(fmt::format("{} ended with the verdict \"{}\"; {}", of, nameOf(found->verdict), wanted));
    const auto age = std::chrono::sys_days(need.day) - std::chrono::sys_days(found->made);
    if (age < std::chrono::days(0))
        return refused(fmt::format("{} is dated after today, {}; set the clock", of, dateText(need.day)));
    if (age > kLoadSafetyHolds) return refused(fmt::format("{} passed {} days ago; {}", of, age.count(), wanted));
    if (const auto open = shortOf(*found, need); !open.empty()) return refused(of + " " + open);
    return *found;
}

std::filesystem::path loadSafetyFile() { return labFile("load-safety.jsonl"); }

}  // namespace tacto
