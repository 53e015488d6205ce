// ScopeLanes.h - the oscilloscope's lanes: the channels of the captures, what is calculated from them, and stored
// references; which records each one shows, and the scales that show them whole.
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
    QString follows;  ///< the lane that a reference was stored from; it is drawn with that lane's scale
    TracePtr stored;  ///< a reference's trace
    bool shown = true;
    std::vector<TraceSpan> spans;   ///< oldest first
    std::vector<TraceSpan> behind;  ///< the captures that persist, oldest first; no trace where a capture lacks it
    [[nodiscard]] bool reference() const noexcept { return stored != nullptr; }
    /// The lowest and the highest of what it shows, in its unit.
    [[nodiscard]] Envelope envelope() const;
    /// The lane whose scale it is drawn with.
    [[nodiscard]] const QString& scaleKey() const noexcept { return follows.isEmpty() ? key : follows; }
};

class ScopeLanes {
public:
    [[nodiscard]] const std::vector<ScopeLane>& all() const noexcept { return lanes_; }
    /// Null without one.
    [[nodiscard]] ScopeLane* find(const QString& key);
    [[nodiscard]] const ScopeLane* find(const QString& key) const;

    /// The lanes of this capture, and the references. Returns whether they are others than before.
    bool take(const ShownCapture& shown);
    /// None but the references.
    void clear();
    /// Sets which records each lane shows. In roll mode they follow each other on the session's time; else the newest
    /// stands alone, from its trigger, with the `persistence` before it behind.
    void fill(const ShownPtr& newest, const std::deque<ShownPtr>& older, bool roll, int persistence);
    /// Adds a reference with the trace of `source`. Returns its key.
    QString store(const QString& source, const Trace& trace);
    void remove(const QString& key);

    /// The records at whose edges a cursor stops: the lane's own, or those of the first lane that has edges.
    [[nodiscard]] const std::vector<TraceSpan>& edgesFor(const QString& key) const;
    /// The lane whose trace comes nearest to `height` between two times, within `reach`; empty without one.
    [[nodiscard]] QString nearest(const Viewport& view, double from_s, double to_s, double height, double reach) const;

    /// Scales with which every lane is as large as it can be, below each other.
    void fit(const ShownCapture& newest, Viewport& view) const;
    /// Whether a lane leaves the screen.
    [[nodiscard]] bool outgrow(const ShownCapture& newest, const Viewport& view) const;

private:
    std::vector<ScopeLane> lanes_;
    int stored_ = 0;  ///< references so far
};

}  // namespace tacto::gui
