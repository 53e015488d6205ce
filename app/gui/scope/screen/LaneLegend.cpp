#include "app/gui/scope/screen/LaneLegend.h"

#include <algorithm>

#include "app/gui/scope/screen/ScopePicture.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

/// Colours of the channels beside the first voltage and the first current; none is red, which means STOP and faults.
constexpr const char* kOtherChannels[] = {"#5E7200", "#C25700", "#6B4FBB", "#8A5A2B",
                                          "#3F6F86", "#9A6B00", "#7B3FA0", "#586068"};

}  // namespace

QColor channelColour(const QString& letter, std::size_t channel) {
    const auto& c = colours();
    if (letter == "V" || letter == "V1") return c.voltage;
    if (letter == "I" || letter == "I1") return c.current;
    return legible(QColor(kOtherChannels[channel % std::size(kOtherChannels)]), c.base);
}

QColor channelInk(const QString& letter, std::size_t channel) {
    const auto& c = colours();
    const auto colour = channelColour(letter, channel);
    return colour == c.current ? c.currentText : legible(colour, c.base);
}

QColor laneColour(const ScopeModel& model, const ScopeLane& lane) {
    const auto& c = colours();
    if (lane.reference()) return c.zero;
    const bool dark = currentTheme() == Theme::Dark;
    if (lane.key == "math/power") return c.third;
    if (lane.key == "math/charge") return dark ? c.third.lighter(125) : c.third.darker(140);
    if (lane.key == "math/difference") return c.text;
    const auto& all = model.lanes();
    const auto at = std::find_if(all.begin(), all.end(), [&](const ScopeLane& l) { return l.key == lane.key; });
    return channelColour(lane.letter, static_cast<std::size_t>(at - all.begin()));  // channels come before calculations
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
    const auto look = [this] {
        // The dashes come from a taller font; a legend that appears must not make the row higher.
        setFixedHeight(QFontMetrics(textFont(TextSize::Small, QFont::DemiBold)).height());
        follow();
    };
    onLookChange(*this, look);
    look();
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
