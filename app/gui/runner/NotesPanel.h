// NotesPanel.h - form for the report's notes: operator, sample, reviewer, ambient conditions. All such panels show and
// change the same notes of the day.
#pragma once

#include <QGroupBox>
#include <QLineEdit>
#include <vector>

#include "app/gui/controller/DayNotes.h"

namespace tacto::gui {

class NotesPanel final : public QGroupBox {
    Q_OBJECT
public:
    /// `day` must outlive the panel.
    explicit NotesPanel(DayNotes& day, QWidget* parent = nullptr);
    [[nodiscard]] RunNotes notes() const;

private:
    void load();
    void takeUp(const QLineEdit& edited);
    DayNotes& day_;
    struct Field {
        QLineEdit* edit;
        std::string RunNotes::*text;
    };
    std::vector<Field> fields_;
};

}  // namespace tacto::gui
