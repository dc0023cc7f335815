// Every stored fill is a triangulation, none is stored twice, and above six corners none is more even.
#include "firmware/simplify/vertex_deletion/fill_patterns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <vector>

namespace usuzumi::testing {
namespace {

using namespace firmware;
using Edge = std::pair<std::uint32_t, std::uint32_t>;
using Fill = std::set<std::vector<std::uint32_t>>;  // triangles, corners rising

Fill fill_of(std::uint32_t corners, std::uint32_t fill) {
  Fill result;
  for (std::uint32_t t = 0; t + 2 < corners; ++t) {
    const FillTriangle f = fill_triangle(corners, fill, t);
    result.insert({f.a, f.b, f.c});
  }
  return result;
}

// All triangulations, by cutting ears off in every order: another way than the one that made the tables.
std::set<Fill> all_by_cutting_ears(std::uint32_t corners) {
  std::set<Fill> result;
  std::vector<std::uint32_t> left(corners);
  for (std::uint32_t i = 0; i < corners; ++i) left[i] = i;
  std::function<void(std::vector<std::uint32_t>, Fill)> cut = [&](std::vector<std::uint32_t> polygon, Fill fill) {
    if (polygon.size() == 2) {
      result.insert(fill);
      return;
    }
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      std::vector<std::uint32_t> ear = {polygon[(i + polygon.size() - 1) % polygon.size()], polygon[i],
                                        polygon[(i + 1) % polygon.size()]};
      std::sort(ear.begin(), ear.end());
      std::vector<std::uint32_t> rest = polygon;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
      Fill with = fill;
      with.insert(ear);
      cut(rest, with);
    }
  };
  cut(left, {});
  return result;
}

std::uint32_t most_triangles_at_a_corner(std::uint32_t corners, const Fill& fill) {
  std::vector<std::uint32_t> count(corners);
  std::uint32_t most = 0;
  for (const auto& triangle : fill)
    for (const std::uint32_t c : triangle) most = std::max(most, ++count[c]);
  return most;
}

TEST(FillPatterns, UpToSixCornersAllTriangulationsAreThere) {
  const std::size_t expected[] = {1, 2, 5, 14};
  for (std::uint32_t n = 3; n <= 6; ++n) {
    std::set<Fill> stored;
    for (std::uint32_t f = 0; f < fill_count(n); ++f) stored.insert(fill_of(n, f));
    EXPECT_EQ(fill_count(n), expected[n - 3]);
    EXPECT_EQ(stored, all_by_cutting_ears(n)) << n << " corners";
  }
}

TEST(FillPatterns, OfSevenAndEightCornersExactlyTheMostEvenAreThere) {
  for (const std::uint32_t n : {7u, 8u}) {
    std::set<Fill> stored, most_even;
    for (std::uint32_t f = 0; f < fill_count(n); ++f) stored.insert(fill_of(n, f));
    for (const Fill& fill : all_by_cutting_ears(n))
      if (most_triangles_at_a_corner(n, fill) <= 3) most_even.insert(fill);
    EXPECT_EQ(stored, most_even) << n << " corners";
  }
}

TEST(FillPatterns, LargeFillsAreDistinctTriangulationsOfThreePerCornerAtMost) {
  for (std::uint32_t n = 7; n <= kMostCorners; ++n) {
    std::set<Fill> stored;
    for (std::uint32_t f = 0; f < fill_count(n); ++f) {
      const Fill fill = fill_of(n, f);
      stored.insert(fill);
      ASSERT_EQ(fill.size(), n - 2);
      EXPECT_LE(most_triangles_at_a_corner(n, fill), 3u);
      // Every side of the polygon is in one triangle, every other edge in two: a disc bounded by the polygon.
      std::multiset<Edge> edges;
      for (const auto& t : fill) edges.insert({{t[0], t[1]}, {t[1], t[2]}, {t[0], t[2]}});
      for (const Edge& e : edges) {
        const bool side = e.second == e.first + 1 || (e.first == 0 && e.second == n - 1);
        EXPECT_EQ(edges.count(e), side ? 1u : 2u) << n << " corners, fill " << f;
      }
    }
    EXPECT_EQ(stored.size(), n);
    EXPECT_EQ(fill_count(n), n);
  }
}

TEST(FillPatterns, FansAreTriangulationsThatMeetInTheirCorner) {
  for (std::uint32_t n = 3; n <= kMostCorners; ++n) {
    for (std::uint32_t apex = 0; apex < n; ++apex) {
      ASSERT_TRUE(is_fan(kFirstFan + apex));
      const Fill fill = fill_of(n, kFirstFan + apex);
      ASSERT_EQ(fill.size(), n - 2);
      std::set<Edge> far_sides;  // of the polygon: all but the two that end in the corner
      for (const auto& t : fill) {
        EXPECT_EQ(std::count(t.begin(), t.end(), apex), 1) << n << " corners";
        std::vector<std::uint32_t> others;
        for (const std::uint32_t c : t)
          if (c != apex) others.push_back(c);
        EXPECT_TRUE(others[1] == others[0] + 1 || (others[0] == 0 && others[1] == n - 1));
        far_sides.insert({others[0], others[1]});
      }
      EXPECT_EQ(far_sides.size(), n - 2);
    }
  }
}

TEST(FillPatterns, TriplesAreNumberedOnce) {
  for (std::uint32_t n = 3; n <= 6; ++n) {
    std::set<std::vector<std::uint32_t>> seen;
    for (std::uint32_t i = 0; i < n * (n - 1) * (n - 2) / 6; ++i) {
      const FillTriangle t = triples()[i];
      EXPECT_TRUE(t.a < t.b && t.b < t.c && t.c < n);
      seen.insert({t.a, t.b, t.c});
    }
    EXPECT_EQ(seen.size(), n * (n - 1) * (n - 2) / 6);
  }
}

}  // namespace
}  // namespace usuzumi::testing
