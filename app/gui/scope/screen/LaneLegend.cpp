#include "app/gui/scope/screen/LaneLegend.h"

#include <algorithm>

#include "app/gui/scope/screen/ScopePicture.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

QColor laneColour(const ScopeModel& model, const ScopeLane& lane) {
    const auto& c = colours();
    if (lane.reference()) return c.zero;
    const bool dark = currentTheme() == Theme::Dark;
    if (lane.key == "math/power") return c.third;
    if (lane.key == "math/charge") return dark ? c.third.lighter(125) : c.third.darker(140);
    if (lane.key == "math/difference") return c.text;
    if (lane.letter == "V" || lane.letter == "V1") return c.voltage;
    if (lane.letter == "I" || lane.letter == "I1") return c.current;
    // Other channels get the remaining colours of the palette, in order.
    const auto& all = model.lanes();
    const auto at = std::find_if(all.begin(), all.end(), [&](const ScopeLane& l) { return l.key == lane.key; });
    return conditionInTheme({}, static_cast<int>(at - all.begin())).color;
}

QColor laneInk(const ScopeModel& model, const ScopeLane& lane) {
    const auto& c = colours();
    const auto colour = laneColour(model, lane);
    return colour == c.current ? c.currentText : legible(colour, c.base);
}

LaneLegend::LaneLegend(const ScopeModel& model, QWidget* parent) : QLabel(parent), model_(model) {
    setObjectName("laneLegend");
    setTextFormat(Qt::RichText);
    setTextSize(*this, TextSize::Small, true);
    connect(&model_, &ScopeModel::viewChanged, this, &LaneLegend::follow);
    connect(&model_, &ScopeModel::lanesChanged, this, &LaneLegend::follow);
    onLookChange(*this, [this] { follow(); });
    follow();
}

void LaneLegend::follow() {
    QStringList entries, words;
    for (const auto& lane : model_.lanes()) {
        if (!lane.shown || lane.reference() || !model_.shown()) continue;
        words << laneScaleText(model_, lane);
        entries << QString("<span style='color:%1'>━━</span>&nbsp;<span style='color:%2'>%3</span>")
                       .arg(laneColour(model_, lane).name(), laneInk(model_, lane).name(),
                            words.back().toHtmlEscaped().replace(' ', "&nbsp;"));
    }
    setVisible(!entries.isEmpty());
    setAccessibleName(words.join(QStringLiteral(", ")));
    setText(entries.join(QStringLiteral("&nbsp;&nbsp;&nbsp; ")));
}

}  // namespace tacto::gui

#include "moc_LaneLegend.cpp"
