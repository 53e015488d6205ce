// StudySessions.h - the sessions of a study as a table, and the way to the result of one that is complete.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLabel>
#include <QPushButton>
#include <QString>
#include <QTableWidget>
#include <QVBoxLayout>
#include <QWidget>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/study/Study.h"

namespace tacto::gui {

class StudySessions final : public QWidget {
    Q_OBJECT
public:
    explicit StudySessions(QWidget* parent = nullptr);
    /// Hidden where there are none.
    void show(const Study& study);
    /// False while the study is not there to be read.
    void setReadable(bool readable);
    /// In the style and size of text that it has where it stands, no wider than that.
    void layOut(int room_px);
    using QWidget::show;

signals:
    void resultWanted(const QString& id);

private:
    void judge();
    /// Null where none is chosen.
    [[nodiscard]] const StudySession* chosen() const;
    std::vector<StudySession> sessions_;  ///< in the order of the rows
    std::string id_;                      ///< of the one that is chosen
    bool readable_ = false;
    int room_ = QWIDGETSIZE_MAX;
    QVBoxLayout* column_;
    QTableWidget* table_ = nullptr;
    QWidget* foot_;
    QPushButton* result_;
};

}  // namespace tacto::gui
