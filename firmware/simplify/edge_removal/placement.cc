#include "firmware/simplify/edge_removal/placement.h"

namespace usuzumi::firmware {
namespace {

float absolute(float x) { return x < 0 ? -x : x; }

// What changes at one end while it moves along the whole edge. On a boundary the outline counts as in the edge's value,
// the area times the edge's length.
struct Amounts {
  float a = 0, b = 0;          // everything that moves
  float net_a = 0, net_b = 0;  // what is left where gains and losses at an end make up for each other
  float same_way = 0;          // > 0: one end gains what the other loses (an S); < 0: both gain or both lose
};

Amounts amounts_of(const EdgeShape& shape) {
  const EndChange &a = shape.at_a, &b = shape.at_b;
  const float l = shape.length;
  return {a.volume + a.outline * l, b.volume + b.outline * l, absolute(a.net_volume) + absolute(a.net_outline) * l,
          absolute(b.net_volume) + absolute(b.net_outline) * l,
          a.net_volume * b.net_volume + a.net_outline * b.net_outline * l * l};
}

// With v1 moved by t E, each plane i at v1 sweeps a tetrahedron of t (N_i . E) A_i / 3; with v2 moved by -(1 - t) E,
// one of (1 - t) (N_i . E) A_i / 3 at v2; the planes on the edge sweep nothing. So the amounts S1 and S2 of fig. 5 are
// t net_a / 3 and (1 - t) net_b / 3, and they are equal at t = net_b / (net_a + net_b). On an S-shape one is a gain and
// the other a loss, and the volume stays.
float equal_change(const Amounts& w) {
  const float net = w.net_a + w.net_b;
  if (net > 0) return w.net_b / net;
  const float all = w.a + w.b;
  return all > 0 ? w.b / all : 0.5f;
}

// All that is swept, |t| a + |1 - t| b, is least at the end that would sweep more. Where both ends lose (or gain), the
// volume lost still grows as the vertex passes over the other end's place, and nothing is lost in sum a little beyond
// the end that stays, where t net_a = (t - 1) net_b with t < 0 or t > 1: the vertex goes there, no further than
// kMostBeyond.
float least_change(const Amounts& w) {
  if (w.a == w.b) return 0.5f;
  const float end = w.a > w.b ? 0.0f : 1.0f;
  if (!(w.same_way < 0) || w.net_a == w.net_b) return end;
  const float t = w.net_b / (w.net_b - w.net_a);
  if (end == 0.0f) return t < 0 && t >= -kMostBeyond ? t : end;
  return t > 1 && t <= 1 + kMostBeyond ? t : end;
}

// Equal ends: the vertex of the lower number stays.
float end_kept(const EdgeShape& shape, const Amounts& w) {
  if (w.a != w.b) return w.a > w.b ? 0.0f : 1.0f;
  return shape.a < shape.b ? 0.0f : 1.0f;
}

}  // namespace

float place_on_edge(const EdgeShape& shape, EdgePlacement placement, bool second_choice) {
  const Amounts w = amounts_of(shape);
  switch (placement) {
    case EdgePlacement::kAutomatic:
      return (w.same_way > 0) != second_choice ? equal_change(w) : least_change(w);
    case EdgePlacement::kEqualVolume: return equal_change(w);
    case EdgePlacement::kLeastVolume: return least_change(w);
    case EdgePlacement::kKeepAnEnd: return end_kept(shape, w);
    case EdgePlacement::kMidpoint: break;
  }
  return 0.5f;
}

bool limit_movement(const EdgeShape& shape, float limit, float& t) {
  if (outline_change(shape, t) <= limit) return true;
  const float p = shape.at_a.outline, q = shape.at_b.outline;
  const float least = p < q ? p : q;
  if (!(least <= limit)) return false;
  t = t < 0 ? 0.0f : (t > 1 ? 1.0f : t);
  if (outline_change(shape, t) <= limit) return true;
  // Between the ends the change is q + t (p - q); p == q would be within the limit here or beyond it everywhere.
  t = (limit - q) / (p - q);
  return true;
}

}  // namespace usuzumi::firmware
