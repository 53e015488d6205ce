// LanePanel.h - a row for each lane: whether it is active and shown, its scale and offset; and the references.
#pragma once

#include <QWidget>
#include <map>

class QButtonGroup;
class QCheckBox;
class QComboBox;
class QGridLayout;
class QPushButton;
class QToolButton;

namespace tacto::gui {

class DivisionSpin;
class ScopeModel;
class ScopeScreen;
struct ScopeLane;

class LanePanel final : public QWidget {
    Q_OBJECT
public:
    /// `model` and `screen` outlive this.
    LanePanel(ScopeModel& model, ScopeScreen& screen, QWidget* parent);

private:
    struct Row {
        QToolButton* letter = nullptr;
        QCheckBox* shown = nullptr;
        QComboBox* scale = nullptr;        ///< null for a reference
        DivisionSpin* position = nullptr;  ///< null for a reference
        QToolButton* remove = nullptr;     ///< removes a reference
    };
    void build();
    void addRow(const ScopeLane& lane, int row);
    void follow();

    ScopeModel& model_;
    ScopeScreen& screen_;
    QGridLayout* grid_;
    QPushButton* store_;
    std::map<QString, Row> rows_;
};

}  // namespace tacto::gui
