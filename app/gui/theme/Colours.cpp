#include "app/gui/theme/Colours.h"

namespace tacto::gui {

namespace {

const Colours kLight{.window = "#F2F4F6",
                     .base = "#FFFFFF",
                     .sunken = "#E8EBEF",
                     .selection = "#DDE3EA",
                     .line = "#CBD0D7",
                     .edge = "#858E9A",
                     .text = "#1A1F25",
                     .quiet = "#4C5662",
                     .primary = "#1F262E",
                     .primaryText = "#FFFFFF",
                     .voltage = "#0072B2",
                     .current = "#009E73",
                     .currentText = "#00795A",
                     .third = "#A8497F",
                     .grid = "#E6E9ED",
                     .zero = "#B4BBC4",
                     .frame = "#6B7480",
                     .amber = "#E69F00",
                     .amberInk = "#1A1F25",
                     .amberText = "#7A4F00",
                     .amberCell = "#FDF1D6",
                     .delivering = "#0072B2",
                     .stop = "#C1121F",
                     .fault = "#C1121F",
                     .banner = "#FCECEC",
                     .pass = "#00735C",
                     .passText = "#00735C",
                     .passCell = "#E3F2EE",
                     .fail = "#1F262E",
                     .failText = "#FFFFFF",
                     .hatch = "#AEB6C0",
                     .bar = "#5E6977",
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

}  // namespace

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
