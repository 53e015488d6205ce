// StudyResults.h - page with the results of an open study: its sessions with their encodings, which encoding is better,
// and the figures, which can be saved. The figures are those of the report (PilotFigures.h).
#pragma once

#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QWidget>

#include "app/gui/study/OpenStudy.h"
#include "app/gui/theme/Labels.h"

class QStackedWidget;

namespace tacto::gui {

class ResultTables;
class SheetView;

class StudyResults final : public QWidget {
    Q_OBJECT
public:
    /// `study` must outlive this.
    explicit StudyResults(OpenStudy& study, QWidget* parent = nullptr);
    void show(const StudyShown& shown);
    using QWidget::show;

signals:
    void backWanted();

private:
    void choose(int row);
    void saveOne();
    void saveAll();
    void useBetter();
    /// Returns the better encoding of the chosen results, if people on real devices decided it.
    [[nodiscard]] QString better() const;
    void saveProfile(const Profile& profile);
    /// Notes in the study that `place` gets figures, which name people; says why not, and returns false.
    [[nodiscard]] bool note(const QString& place);

    OpenStudy& study_;
    StudyShown shown_;
    QListWidget* list_;
    QStackedWidget* pages_;
    ResultTables* tables_ = nullptr;
    SheetView* sheet_ = nullptr;
    QLabel* legend_ = nullptr;
    QLabel* said_;
    QPushButton* save_;
    QPushButton* saveAll_;
    QPushButton* use_;
};

}  // namespace tacto::gui
