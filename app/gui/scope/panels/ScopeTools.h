// ScopeTools.h - the row of tools above the oscilloscope's screen.
#pragma once

#include <QPushButton>
#include <QToolButton>
#include <map>

#include "app/gui/scope/panels/ScopeAcquisition.h"

class QActionGroup;
class QMenu;

namespace tacto::gui {

class PictureTools;
class ToolRow;

enum class ScopeTool { Fit, Undo, Box, TimeCursors, LevelCursors, Average, Mask, Spectrum, Table, Mark, Controls };

class ScopeTools final : public QWidget {
    Q_OBJECT
public:
    /// `files` is the menu of the Save button.
    ScopeTools(QMenu* files, QWidget* parent);
    /// The owner decides what a click on these buttons does.
    [[nodiscard]] QPushButton& run() const { return *run_; }
    [[nodiscard]] QToolButton& tool(ScopeTool which) const { return *tools_.at(which); }
    /// Save opens the menu `files`; the owner decides what Copy and "Plot only" do.
    [[nodiscard]] PictureTools& pictures() const { return *pictures_; }
    void showMode(ScopeMode mode);
    void showRunning(bool running, bool possible);
    /// Steps below `least_s` cannot be chosen.
    void showTimeBase(double perDivision_s, double least_s);

signals:
    void modeChosen(tacto::gui::ScopeMode mode);
    void timeBaseChosen(double perDivision_s);

private:
    void addModes(ToolRow& row);
    void markTimeBase();

    QPushButton* run_;
    PictureTools* pictures_ = nullptr;
    QToolButton* single_ = nullptr;
    QToolButton* mode_ = nullptr;
    QActionGroup* modes_;
    QToolButton* base_ = nullptr;
    QActionGroup* bases_ = nullptr;
    double base_s_ = 0, leastBase_s_ = 0;
    std::map<ScopeTool, QToolButton*> tools_;
};

}  // namespace tacto::gui
