// WelcomeTour.h - the tour that a first start begins with: from nothing to a measured pulse and a verdict, on the
// simulated bench, in five minutes.
#pragma once

#include <QObject>

#include "app/gui/controller/BenchController.h"
#include "app/gui/window/Tour.h"

namespace tacto::gui {

class MainWindow;
class TabbedPage;

class WelcomeTour final : public QObject {
    Q_OBJECT
public:
    /// The window owns it. What was left or finished is not begun again by itself ("tourDone" in the settings); where
    /// it was left is kept as well ("tourStep").
    explicit WelcomeTour(MainWindow& window);
    /// Begins where it was left, else at the first step; beyond the opened bench only while a simulated one is open.
    void begin();

private:
    [[nodiscard]] std::vector<TourStep> onTheBench();
    [[nodiscard]] std::vector<TourStep> toTheVerdict();
    [[nodiscard]] QWidget* named(const char* name) const;
    [[nodiscard]] TourTarget workspaceButton(int index) const;
    [[nodiscard]] TourTarget armTarget() const;
    [[nodiscard]] std::function<QString()> whileOn(const QString& text) const;
    [[nodiscard]] TourTarget scopeTarget() const;
    [[nodiscard]] TourTarget sessionsTarget();
    [[nodiscard]] TourTarget runTarget() const;
    [[nodiscard]] bool showsScope() const;
    [[nodiscard]] InterlockState state() const;
    /// Something is open that is not simulated.
    [[nodiscard]] bool isReal() const;

    MainWindow& window_;
    BenchController& controller_;
    Tour* tour_ = nullptr;
    // When the present step began:
    StopMark begun_;
    int presented_ = 0;
    int captured_ = 0;
    int judged_ = 0;
    QString newest_;  ///< session of a run, to be shown
};

}  // namespace tacto::gui
