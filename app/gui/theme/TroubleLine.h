// TroubleLine.h - "⚠ " and why something cannot be done, in amber, below what it is about; not there while all is well.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLabel>

namespace tacto::gui {

class TroubleLine final : public QLabel {
public:
    /// `name` as object name.
    TroubleLine(const QString& name, QWidget* parent);
    /// An empty text: all is well.
    void say(const QString& why);
};

}  // namespace tacto::gui
