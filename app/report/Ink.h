// Ink.h - the colours on paper, by role. The window's light theme takes shared roles from here
// (app/gui/theme/Colours.cpp), so that a verdict, a limit and a trace have the same colour on screen and in a report.
#pragma once

#include <QColor>

namespace tacto::ink {

inline const QColor kWindow(0xf2, 0xf4, 0xf6);  ///< background of separate text, such as a command
inline const QColor kText(0x1a, 0x1f, 0x25);
inline const QColor kQuiet(0x4c, 0x56, 0x62);  ///< secondary text
inline const QColor kAxis(0x6b, 0x74, 0x80);   ///< frames of plots
inline const QColor kGrid(0xe6, 0xe9, 0xed);
inline const QColor kLine(0xcb, 0xd0, 0xd7);    ///< separators
inline const QColor kSunken(0xe8, 0xeb, 0xef);  ///< background of what was stopped or not judged
inline const QColor kVoltage(0x00, 0x72, 0xb2);
inline const QColor kCurrent(0x00, 0x9e, 0x73);
inline const QColor kThird(0xa8, 0x49, 0x7f);
inline const QColor kAmber(0xe6, 0x9f, 0x00);      ///< close to a limit: fills and tolerance edges
inline const QColor kAmberCell(0xfd, 0xf1, 0xd6);  ///< background of a cell close to its limit
inline const QColor kAmberText(0x7a, 0x4f, 0x00);  ///< words on kAmberCell
inline const QColor kFault(0xc1, 0x12, 0x1f);      ///< only for words and marks of faults
inline const QColor kPass(0x00, 0x73, 0x5c);       ///< background for white text
inline const QColor kFail(0x1f, 0x26, 0x2e);       ///< under white text; not red, which means STOP and faults
inline const QColor kBar(0x5e, 0x69, 0x77);        ///< a limit used to less than 80 %
inline const QColor kHatch(0xae, 0xb6, 0xc0);      ///< not evaluated

}  // namespace tacto::ink
