// ScopeColumns.h - the oscilloscope's parts on the page: tools above, status beside them or below; screen, spectrum and
// measurements below each other; the controls beside them, where there is room.
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
    /// The tools, and the status beside them where there is room: above the columns unless a page takes it.
    [[nodiscard]] QWidget& head() { return *head_; }
    /// Shows or hides the controls; here also where they take room from the screen.
    void askForControls(bool on);

    /// Goes back to the first start: the screen has all the room.
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
    bool forced_ = false;  ///< asked for where there is no room for them
};

}  // namespace tacto::gui
