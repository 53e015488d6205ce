#include "app/gui/theme/Colours.h"

#include <algorithm>
#include <cmath>

#include "app/report/Ink.h"

namespace tacto::gui {

namespace {

const Colours kLight{.window = ink::kWindow,
                     .base = "#FFFFFF",
                     .sunken = ink::kSunken,
                     .selection = "#DDE3EA",
                     .line = ink::kLine,
                     .edge = "#858E9A",
                     .text = ink::kText,
                     .quiet = ink::kQuiet,
                     .primary = "#1F262E",
                     .primaryText = "#FFFFFF",
                     .voltage = ink::kVoltage,
                     .current = ink::kCurrent,
                     .currentText = "#00795A",
                     .third = ink::kThird,
                     .grid = ink::kGrid,
                     .zero = "#B4BBC4",
                     .frame = ink::kAxis,
                     .amber = ink::kAmber,
                     .amberInk = "#1A1F25",
                     .amberText = ink::kAmberText,
                     .amberCell = ink::kAmberCell,
                     .delivering = "#0072B2",
                     .stop = ink::kFault,
                     .fault = ink::kFault,
                     .banner = "#FCECEC",
                     .pass = ink::kPass,
                     .passText = ink::kPass,
                     .passCell = "#E3F2EE",
                     .fail = ink::kFail,
                     .failText = "#FFFFFF",
                     .hatch = ink::kHatch,
                     .bar = ink::kBar,
                     .watermark = QColor(0x1A, 0x1F, 0x25, 15)};

const Colours kDark{.window = "#14171B",
                    .base = "#1B1F24",
                    .sunken = "#23282E",
                    .selection = "#2E353E",
                    .line = "#363D46",
                    .edge = "#7A8490",
                    .text = "#E9ECEF",
                    .quiet = "#A9B2BC",
                    .primary = "#E4E8EC",
                    .primaryText = "#14171B",
                    .voltage = "#56B4E9",
                    .current = "#27C498",
                    .currentText = "#27C498",
                    .third = "#DB8DBB",
                    .grid = "#272D34",
                    .zero = "#4A535E",
                    .frame = "#8B95A1",
                    .amber = "#F0AE1D",
                    .amberInk = "#14171B",
                    .amberText = "#F5C558",
                    .amberCell = "#3A2D10",
                    .delivering = "#0072B2",
                    .stop = "#D0202B",
                    .fault = "#FF7A7F",
                    .banner = "#35191C",
                    .pass = "#00735C",
                    .passText = "#2FBF9A",
                    .passCell = "#16302A",
                    .fail = "#E4E8EC",
                    .failText = "#14171B",
                    .hatch = "#5A636E",
                    .bar = "#8B95A1",
                    .watermark = QColor(255, 255, 255, 14)};

double luminance(const QColor& colour) {
    const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
    return 0.2126 * linear(colour.redF()) + 0.7152 * linear(colour.greenF()) + 0.0722 * linear(colour.blueF());
}

}  // namespace

double contrast(const QColor& a, const QColor& b) {
    const auto [low, high] = std::minmax({luminance(a), luminance(b)});
    return (high + 0.05) / (low + 0.05);
}

QColor legible(QColor ink, const QColor& paper) {
    constexpr double kWords = 4.5;
    constexpr int kStep = 105, kMaxSteps = 40;  // percent
    const bool darker = contrast(paper, Qt::black) > contrast(paper, Qt::white);
    for (int i = 0; i < kMaxSteps && contrast(ink, paper) < kWords; ++i)
        ink = darker ? ink.darker(kStep) : ink.lighter(kStep);
    return ink;
}

const Colours& coloursOf(Theme theme) { return theme == Theme::Dark ? kDark : kLight; }

QPalette paletteOf(const Colours& c) {
    QPalette p;
    const std::pair<QPalette::ColorRole, QColor> roles[] = {
        {QPalette::Window, c.window},
        {QPalette::WindowText, c.text},
        {QPalette::Base, c.base},
        {QPalette::AlternateBase, c.window},
        {QPalette::Text, c.text},
        {QPalette::PlaceholderText, c.quiet},
        {QPalette::Button, c.base},
        {QPalette::ButtonText, c.text},
        {QPalette::BrightText, c.fault},
        {QPalette::Highlight, c.selection},
        {QPalette::HighlightedText, c.text},
        {QPalette::ToolTipBase, c.base},
        {QPalette::ToolTipText, c.text},
        {QPalette::Link, c.voltage},
        {QPalette::LinkVisited, c.voltage},
        {QPalette::Mid, c.line},
        {QPalette::Midlight, c.sunken},
        {QPalette::Dark, c.edge},
        {QPalette::Light, c.base},
        {QPalette::Shadow, c.frame},
    };
    for (const auto& [role, colour] : roles) p.setColor(role, colour);
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
        p.setColor(QPalette::Disabled, role, c.edge);
    return p;
}

}  // namespace tacto::gui
