// ScopeColumns.h - places the parts of the oscilloscope: tools at the top, status next to or below the tools, then
// screen, spectrum and measurements, and the controls at the right if the page is wide enough.
#pragma once

#include <QWidget>

class QBoxLayout;
class QSettings;
class QSplitter;

namespace tacto::gui {

class MeasurementTable;
class ScopeControls;
class ScopeScreen;
class ScopeStatus;
class ScopeTools;
class SpectrumPanel;

class ScopeColumns final : public QWidget {
    Q_OBJECT
public:
    struct Parts {
        ScopeTools& tools;
        ScopeStatus& status;
        ScopeScreen& screen;
        SpectrumPanel& spectrum;
        MeasurementTable& table;
        ScopeControls& controls;
    };
    ScopeColumns(const Parts& parts, QWidget* parent);
    /// The row of the tools, in a wide window also of the status. It is above the columns unless a page takes it.
    [[nodiscard]] QWidget& head() { return *head_; }
    /// Shows or hides the controls, even if they take room from the screen.
    void askForControls(bool on);

    /// Restores the layout of the first start: the screen has all the room.
    void reset();
    void save(QSettings& settings) const;
    void restore(QSettings& settings);

private:
    void placeStatus();
    void fitControls();

    Parts parts_;
    QWidget* head_;
    QBoxLayout* column_ = nullptr;
    QSplitter* plots_;
    bool wanted_ = false;
    bool forced_ = false;  ///< the user asked for the controls although they have too little room
};

}  // namespace tacto::gui
