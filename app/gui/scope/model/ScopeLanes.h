// ScopeLanes.h - the oscilloscope's lanes: channels of the captures, curves calculated from them, and stored
// references; the records each lane shows, and the scales that fit them to the screen.
//
// Thread-safety: one owner.
#pragma once

#include <deque>
#include <vector>

#include "app/gui/scope/model/Trace.h"
#include "app/gui/scope/model/Viewport.h"

namespace tacto::gui {

struct ScopeLane {
    QString key;
    QString title;
    QString letter;  ///< the letter on its handle
    QString unit;
    QString follows;  ///< for a reference: the lane it was stored from, and with whose scale it is drawn
    TracePtr stored;  ///< a reference's trace
    bool shown = true;
    std::vector<TraceSpan> spans;   ///< oldest first
    std::vector<TraceSpan> behind;  ///< older captures that stay, oldest first; null trace if a capture lacks this lane
    [[nodiscard]] bool reference() const noexcept { return stored != nullptr; }
    /// The lowest and the highest value shown, in the lane's unit.
    [[nodiscard]] Envelope envelope() const;
    /// The key of the lane with whose scale this lane is drawn.
    [[nodiscard]] const QString& scaleKey() const noexcept { return follows.isEmpty() ? key : follows; }
};

class ScopeLanes {
public:
    [[nodiscard]] const std::vector<ScopeLane>& all() const noexcept { return lanes_; }
    /// Returns null if there is no such lane.
    [[nodiscard]] ScopeLane* find(const QString& key);
    [[nodiscard]] const ScopeLane* find(const QString& key) const;

    /// Takes over the lanes of a capture, and keeps the references. Returns true if the lanes changed.
    bool take(const ShownCapture& shown);
    /// Removes all lanes except the references.
    void clear();
    /// Sets the records that each lane shows. In roll mode the records follow each other on the session's time.
    /// Otherwise the newest record starts at its trigger, with `persistence` older records behind it.
    void fill(const ShownPtr& newest, const std::deque<ShownPtr>& older, bool roll, int persistence);
    /// Adds a reference with the trace of lane `source`. Returns the reference's key.
    QString store(const QString& source, const Trace& trace);
    void remove(const QString& key);

    /// The records whose edges attract a cursor: those of this lane, or of the first lane that has edges.
    [[nodiscard]] const std::vector<TraceSpan>& edgesFor(const QString& key) const;
    /// Returns the lane whose trace is nearest to `height` between two times; empty if none is within `reach`.
    [[nodiscard]] QString nearest(const Viewport& view, double from_s, double to_s, double height, double reach) const;

    /// Sets scales that show each lane as large as possible, the lanes one below the other.
    void fit(const ShownCapture& newest, Viewport& view) const;
    /// True if a lane extends beyond the screen.
    [[nodiscard]] bool outgrow(const ShownCapture& newest, const Viewport& view) const;

private:
    std::vector<ScopeLane> lanes_;
    int stored_ = 0;  ///< number of references stored so far
};

}  // namespace tacto::gui
