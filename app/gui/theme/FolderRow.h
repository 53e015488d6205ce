// FolderRow.h - a folder that is to be made: its path as text, and a button that chooses it.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QWidget>

#include "app/gui/theme/PathField.h"

namespace tacto::gui {

class FolderRow final : public QWidget {
    Q_OBJECT
public:
    /// `tip`: what is expected. `question`: the title of the dialog in which it is chosen.
    FolderRow(const QString& path, const QString& tip, const QString& question, QWidget* parent);
    [[nodiscard]] PathField& line() const { return *line_; }
    /// Blanks trimmed.
    [[nodiscard]] QString folder() const { return line_->text().trimmed(); }

private:
    PathField* line_;
};

}  // namespace tacto::gui
