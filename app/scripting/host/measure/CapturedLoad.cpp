// Reads the effect of trains on a load from captures.
#include <algorithm>
#include <cmath>
#include <span>

#include "app/scripting/host/measure/Readings.h"
#include "core/analysis/load_safety/LoadSafetyJson.h"
#include "core/base/Statistics.h"

namespace tacto::host::measure {

namespace {

/// Returns the programmed amplitude if the last trains, one more than were captured, were all programmed alike: even an
/// instrument with coarse time stamps has then seen no other. Else NaN.
double settledAt(const Telemetry& now, std::size_t captures) {
    auto programmed = now.programmed;
    std::ranges::sort(programmed, std::ranges::greater(), &ProgrammedTrain::onset);
    const auto last = std::span(programmed).first(std::min(captures + 1, programmed.size()));
    const bool same = captures < programmed.size() && std::ranges::all_of(last, [&](const auto& train) {
                          return train.amplitude == last.front().amplitude;
                      });
    return same ? last.front().amplitude : kNaN;
}

}  // namespace

Result<Json> loadReading(ScriptSession& session, const LoadCaptures& captures) {
    const auto given = capturesGiven(session, captures.trains);
    if (!given) return failure(given);
    const auto fine = capturesGiven(session, captures.fine);
    if (!fine) return failure(fine);
    const auto rhythm = capturesGiven(session, captures.rhythm);
    if (!rhythm) return failure(rhythm);
    const auto& train = session.bench().profile().encoding.train;
    ExpectedTrain expected{train.pulses, train.rate.value()};
    if (const auto& stimulator = session.bench().devices().stimulator) expected.drive = stimulator->traits().drive;
    if (captures.byVoltage) expected.drive = Drive::Voltage;
    // A calibrated stimulator is programmed to another value than it should deliver.
    const auto& calibration = session.bench().calibration();
    const double settled = settledAt(session.bench().telemetry(), given->captures.size());
    for (const auto& capture : given->captures) {
        const double programmed = std::isnan(capture.programmed) ? settled : capture.programmed;
        expected.programmed.push_back(calibration ? calibration->amplitude.delivered(programmed) : programmed);
    }
    expected.budget.seed = session.request().seed;
    auto reading = readLoad(given->captures, expected, fine->captures,
                            rhythm->captures.empty() ? nullptr : &rhythm->captures.front());
    if (!reading) return failure(reading);
    Json out = toJson(*reading);
    out["captures"] = given->ids;
    return out;
}

}  // namespace tacto::host::measure
