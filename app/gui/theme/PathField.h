// PathField.h - a folder or file as text: a path without room is read from its beginning; the tool tip has all of it.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLineEdit>

namespace tacto::gui {

class PathField final : public QLineEdit {
public:
    /// `tip`: what is expected, below the path in the tool tip.
    PathField(const QString& path, const QString& tip, QWidget* parent);
};

}  // namespace tacto::gui
