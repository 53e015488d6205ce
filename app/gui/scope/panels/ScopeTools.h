// ScopeTools.h - the row of tools above the oscilloscope's screen.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QWidget>

#include "app/gui/scope/panels/ScopeAcquisition.h"

class QActionGroup;
class QMenu;
class QPushButton;
class QToolButton;

namespace tacto::gui {

class PictureTools;
class ToolRow;

class ScopeTools final : public QWidget {
    Q_OBJECT
public:
    /// `files` is the menu of the button that saves.
    ScopeTools(QMenu* files, QWidget* parent);
    /// Save opens `files`; what Copy and Plot only do is the owner's.
    [[nodiscard]] PictureTools& pictures() const { return *pictures_; }
    void showMode(ScopeMode mode);
    void showRunning(bool running, bool possible);
    /// Those below `least_s` cannot be chosen.
    void showTimeBase(double perDivision_s, double least_s);
    void showControls(bool on);
    void showTable(bool on);
    void showSpectrum(bool on);
    void showAverage(bool on);
    void showMask(bool on, bool possible);
    void setCanUndo(bool can);
    void endBox();

public slots:
    void toggleTimeCursors();
    void toggleLevelCursors();
    void toggleBox();

signals:
    void runClicked();
    void modeChosen(tacto::gui::ScopeMode mode);
    void timeBaseChosen(double perDivision_s);
    void fitClicked();
    void undoClicked();
    void boxToggled(bool on);
    void timeCursorsToggled(bool on);
    void levelCursorsToggled(bool on);
    void averageClicked(bool on);
    void maskClicked(bool on);
    void spectrumClicked(bool on);
    void tableClicked(bool on);
    void controlsClicked(bool on);
    void markClicked();

protected:
    void resizeEvent(QResizeEvent* event) override;

private:
    /// With an icon, `text` is its name for screen readers.
    QToolButton* tool(const QString& text, const QString& tip, bool checkable, const QString& iconName = {});
    void addModes(ToolRow& row);
    void addViews(ToolRow& row);
    void addPanels(ToolRow& row);
    void markTimeBase();

    QPushButton* run_;
    PictureTools* pictures_ = nullptr;
    QToolButton* single_ = nullptr;
    QToolButton* mode_ = nullptr;
    QActionGroup* modes_;
    QToolButton* base_ = nullptr;
    QActionGroup* bases_ = nullptr;
    double base_s_ = 0, leastBase_s_ = 0;
    QToolButton* undo_ = nullptr;
    QToolButton* box_ = nullptr;
    QToolButton* time_ = nullptr;
    QToolButton* level_ = nullptr;
    QToolButton* average_ = nullptr;
    QToolButton* mask_ = nullptr;
    QToolButton* spectrum_ = nullptr;
    QToolButton* table_ = nullptr;
    QToolButton* controls_ = nullptr;
};

}  // namespace tacto::gui
