// NotesPanel.h - what the report says beside what is measured: operator, reviewer, ambient conditions. Kept while the
// window is open and not beyond: the next person at the bench may be another.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QGroupBox>
#include <QLineEdit>

#include "app/run/RunNotes.h"

namespace tacto::gui {

class NotesPanel final : public QGroupBox {
    Q_OBJECT
public:
    explicit NotesPanel(QWidget* parent = nullptr);
    [[nodiscard]] RunNotes notes() const;

private:
    [[nodiscard]] QLineEdit* field(const char* name, const QString& placeholder, const QString& tip);
    QLineEdit* operator_;
    QLineEdit* reviewer_;
    QLineEdit* ambient_;
};

}  // namespace tacto::gui
