// NotesPanel.h - what the report says beside the measurements: operator, sample, reviewer, ambient conditions. Every
// such panel shows and changes the same notes of the day.
#pragma once

#include <QGroupBox>
#include <QLineEdit>
#include <vector>

#include "app/gui/controller/DayNotes.h"

namespace tacto::gui {

class NotesPanel final : public QGroupBox {
    Q_OBJECT
public:
    /// `day` outlives the panel.
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
