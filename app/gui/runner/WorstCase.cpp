#include "app/gui/runner/WorstCase.h"

#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "core/bench/arming/CommandPreview.h"
#include "core/electrode/Load.h"

namespace tacto::gui {

Result<WorstCase> worstCase(const Profile& profile, const std::vector<LimitSet>& limits, const std::string& load) {
    const auto parsed = parseLoad(load);
    if (!parsed) return failure(parsed);
    const Command strongest{profile.encoding.amplitudeMax, profile.encoding.intervalMin};
    auto preview = previewOf(strongest, profile, limits, *parsed);
    if (!preview) return failure(preview);
    WorstCase worst{std::move(preview->rows), {}};
    if (!preview->refusal) return worst;
    const auto* row = firstForbidding(worst.rows);
    worst.refused = row == nullptr
                        ? sentence(*preview->refusal)
                        : QObject::tr("%1 would be %2; %3 %4 is allowed (%5). Such a train will be refused.")
                              .arg(qtext(titleOf(row->quantity)), quantityText(row->value, qtext(row->unit), 3),
                                   row->strict ? QObject::tr("less than") : QObject::tr("at most"),
                                   settingText(row->limit, qtext(row->unit)), qtext(titleOf(limits, row->set.view())));
    return worst;
}

}  // namespace tacto::gui
