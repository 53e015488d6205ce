#include "app/gui/runner/WorstCase.h"

#include "app/gui/theme/ExposureTable.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/electrode/Load.h"
#include "core/encoding/Encoder.h"

namespace tacto::gui {

namespace {

SourceTraits idealSource() {
    SourceTraits source;
    source.drive = Drive::Voltage;
    source.amplitudeMax = 500;
    source.compliance = Volts(500);
    return source;
}

}  // namespace

Result<WorstCase> worstCase(const Profile& profile, const std::vector<LimitSet>& limits, const std::string& load) {
    const auto parsed = parseLoad(load);
    if (!parsed) return failure(parsed);
    if (const auto valid = validate(profile.encoding); !valid) return failure(valid);
    GateSetup setup;
    setup.source = idealSource();
    setup.load = LoadRange::declared(*parsed);
    setup.limits = limits;
    setup.ceilings = profile.ceilings;
    setup.electrodeArea = profile.electrodeArea;
    setup.check = profile.encoding.train;
    WorstCase worst;
    worst.rows = exposureTable(setup, voltageTrain(profile.encoding, profile.encoding.amplitudeMax),
                               profile.encoding.intervalMin);
    for (const auto& row : worst.rows) {
        if (row.action != LimitAction::Refuse || std::isnan(row.limit) || !row.evaluated || row.within) continue;
        worst.refused = QObject::tr("%1 would be %2; %3 %4 is allowed (%5). Such a train will be refused.")
                            .arg(qtext(titleOf(row.quantity)), quantityText(row.value, qtext(row.unit), 3),
                                 row.strict ? QObject::tr("less than") : QObject::tr("at most"),
                                 settingText(row.limit, qtext(row.unit)), qtext(titleOf(limits, row.set.view())));
        break;
    }
    return worst;
}

}  // namespace tacto::gui
