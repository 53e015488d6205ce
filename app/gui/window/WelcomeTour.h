// WelcomeTour.h - the tour of the first start: from nothing to a measured pulse and a verdict in five minutes, on the
// simulated bench.
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
    /// The window owns this. A tour that was finished or left does not start again by itself ("tourDone" in the
    /// settings); the step at which it was left is kept ("tourStep").
    explicit WelcomeTour(MainWindow& window);
    /// Begins where the tour was left. Goes beyond the step that opens the bench only if a simulated bench is open.
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
    /// True if the open bench is not simulated.
    [[nodiscard]] bool isReal() const;

    MainWindow& window_;
    BenchController& controller_;
    Tour* tour_ = nullptr;
    // State when the present step began:
    StopMark begun_;
    int presented_ = 0;
    int captured_ = 0;
    int judged_ = 0;
    QString newest_;  ///< the session of a run, which the tour will show
};

}  // namespace tacto::gui
