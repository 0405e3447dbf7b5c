/*
 * lightbvh for C and C++: samples one of many moving lights, with its exact probability.
 *
 * Lengths are metres, radiance is W/(m^2 sr) in linear RGB. A function that may fail returns a lightbvh_status;
 * lightbvh_last_error() then says in words what was wrong and what to do. A function that fails has changed nothing and
 * written nothing to its results. No function lets a Rust panic out, or ends the program but where memory does.
 *
 * One light BVH may be read by several threads at once (functions that take a const lightbvh *), or changed by one.
 */
#ifndef LIGHTBVH_H
#define LIGHTBVH_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A light BVH: meshes of emissive triangles, their instances in the world, and the trees over them. */
typedef struct lightbvh lightbvh;

/* What a function did. */
typedef enum lightbvh_status {
    LIGHTBVH_OK = 0,
    /* A pointer is null or not aligned, or a length is beyond all memory. */
    LIGHTBVH_BAD_POINTER = 1,
    /* An edit, or an id, is refused: it is not in use, a number is out of its range, a mesh in use, ... */
    LIGHTBVH_REFUSED = 2,
    /* A point is not within 2^40 m, its normal is neither zero nor of length 1, or a number is not in [0, 1). */
    LIGHTBVH_BAD_POINT = 3,
    /* There is no light of that number in that instance. */
    LIGHTBVH_NO_LIGHT = 4,
    /* A defect of this library. A light BVH that was being changed then only can be freed, as can a rebuilder. */
    LIGHTBVH_PANICKED = 5,
    /* A background build failed; the light BVH keeps its trees, and the next frame starts another build. */
    LIGHTBVH_NO_REBUILD = 6
} lightbvh_status;

/* A mesh. All zero is no mesh; an id of a removed mesh, or of another light BVH, is refused: an id that is kept is never
 * another's. `generation` tells it from earlier ones of the same `index`, `kind` tells meshes from instances. */
typedef struct lightbvh_mesh {
    uint32_t tree, index, generation, kind;
} lightbvh_mesh;

/* An instance, as lightbvh_mesh. lightbvh_sample.instance is the `index` of one; which id that is, the caller knows, who was
 * given it. */
typedef struct lightbvh_instance {
    uint32_t tree, index, generation, kind;
} lightbvh_instance;

/* lightbvh_triangle.flags: both sides emit. */
#define LIGHTBVH_TWO_SIDED 1u
/* lightbvh_sample.light and .instance where there is no light with flux. */
#define LIGHTBVH_INVALID UINT32_MAX

/* A triangle that emits from its front, the side from which its vertices run counter-clockwise. */
typedef struct lightbvh_triangle {
    float p[3][3];     /* vertices; coordinates within 2^40 */
    float radiance[3]; /* each 0, or from 2^-100 to 2^100 */
    uint32_t mesh;     /* ignored */
    uint32_t flags;    /* 0 or LIGHTBVH_TWO_SIDED */
} lightbvh_triangle;

/* An affine map from the mesh's space to the world: x -> A x + t. */
typedef struct lightbvh_transform {
    float columns[3][3];  /* the columns of A */
    float translation[3]; /* t */
} lightbvh_transform;

/* A point to be lit. The normal is of length 1, or zero for a point in a volume. */
typedef struct lightbvh_point {
    float p[3];
    float n[3];
} lightbvh_point;

/* A light and the probability with which it was chosen. */
typedef struct lightbvh_sample {
    uint32_t light;
    uint32_t instance; /* index of the instance: lightbvh_instance.index */
    float pmf;         /* in (0, 1]; 0 with LIGHTBVH_INVALID */
} lightbvh_sample;

/* A point on a light. Seen at distance d under the cosine c of its normal, a light chosen with probability pmf has the
 * density pmf * density * d * d / c over solid angle. */
typedef struct lightbvh_light_point {
    float p[3];
    float density;     /* over the triangle's area, 1/m^2; 0 where it has none */
    float normal[3];   /* of the front side, of length 1 */
    uint32_t flags;    /* lightbvh_triangle.flags */
    float radiance[3];
} lightbvh_light_point;

/* Numbers of lights: `count` from `first` on. */
typedef struct lightbvh_range {
    uint32_t first, count;
} lightbvh_range;

/* Builds the trees of one light BVH again, on a thread of its own. */
typedef struct lightbvh_rebuilder lightbvh_rebuilder;

/* What the start of a frame did. */
typedef struct lightbvh_frame_start {
    uint32_t swapped; /* 1 if a new tree over the instances was swapped in */
    uint32_t meshes;  /* number of meshes that got new trees */
} lightbvh_frame_start;

/* What the last function that failed on this thread had to say, in UTF-8; "" before any did. It stays until the next one
 * fails on this thread. Never null. */
const char *lightbvh_last_error(void);

/* A light BVH without lights, to be freed by lightbvh_free; null only where memory or the library fails. */
lightbvh *lightbvh_create(void);
/* Frees it. Null does nothing. */
void lightbvh_free(lightbvh *bvh);

/* Edits. Samples see them after the next lightbvh_refit. A count of more than 2^30 is refused; with one of 0 a pointer may be
 * null. */

/* A new mesh of `count` triangles, at least one and at most 2^30, in the mesh's own space. It is not in the world yet. */
lightbvh_status lightbvh_add_mesh(lightbvh *bvh, const lightbvh_triangle *triangles, size_t count, lightbvh_mesh *mesh);
/* Puts a mesh into the world at `count` places, all or none of them. `radiance` is a factor on that of the mesh, linear RGB: each
 * 0, or from 2^-60 to 2^60. Many together take less time than one at a time. */
lightbvh_status lightbvh_add_instances(lightbvh *bvh, lightbvh_mesh mesh, const lightbvh_transform *transforms,
                                       const float radiance[3], size_t count, lightbvh_instance *instances);
lightbvh_status lightbvh_set_transform(lightbvh *bvh, lightbvh_instance instance, const lightbvh_transform *transform);
/* As the factor of lightbvh_add_instances; zeros turn the instance off. */
lightbvh_status lightbvh_set_radiance(lightbvh *bvh, lightbvh_instance instance, const float radiance[3]);
/* New vertices or radiance of `count` triangles from index `first` of a mesh on, in all its instances: lightbvh_refit then
 * computes what leads to them alone. */
lightbvh_status lightbvh_set_triangle_range(lightbvh *bvh, lightbvh_mesh mesh, uint32_t first,
                                            const lightbvh_triangle *triangles, size_t count);
lightbvh_status lightbvh_remove_instance(lightbvh *bvh, lightbvh_instance instance);
/* Removes a mesh that has no instances. */
lightbvh_status lightbvh_remove_mesh(lightbvh *bvh, lightbvh_mesh mesh);

/* Computes the nodes that the edits touched: once a frame. */
lightbvh_status lightbvh_refit(lightbvh *bvh);

/* Frames: lightbvh_begin_frame, edits, lightbvh_refit, lightbvh_end_frame. A rebuilder builds the tree over the instances
 * after any change, and that of a mesh after changes of its triangles. Begin and end of a frame take time in proportion to
 * the frame's changes, and copy changed meshes (docs/dynamics.md). One light BVH has one rebuilder. */

/* A rebuilder, to be freed by lightbvh_rebuilder_free; null only if memory or the library fails. If `after` is 0, trees are
 * swapped in once they are ready, and no frame waits. Otherwise they are swapped in after `after` frames, and that frame
 * waits for them if needed: samples then depend on the edits alone, never on the thread's speed. */
lightbvh_rebuilder *lightbvh_rebuilder_create(uint32_t after);
/* Waits for the build under way, 0.4 s for a mesh of 10^6 triangles, and frees it. Null does nothing. */
void lightbvh_rebuilder_free(lightbvh_rebuilder *rebuilder);
/* Swaps in finished trees. Call it before the frame's edits. `start` may be null. */
lightbvh_status lightbvh_begin_frame(lightbvh_rebuilder *rebuilder, lightbvh *bvh, lightbvh_frame_start *start);
/* Starts the next build. Call it after the frame's lightbvh_refit. */
lightbvh_status lightbvh_end_frame(lightbvh_rebuilder *rebuilder, const lightbvh *bvh);

/* What keeps numbers of lights from frame to frame, as reservoirs do, asks in each frame after its edits which numbers are no
 * more, replaces what it keeps of them, and has them forgotten: until then no new light gets such a number. The exception keeps
 * memory bounded where they never are: once more of them wait than 65536 and than there are lights (or than half of what is
 * left of 2^30, where that is less), all of them are free. The first range then covers every number there was, those of lights
 * that are still there too: what is kept by number is dropped as a whole. */

/* Ranges of numbers of lights that are no more, since they were forgotten last: `count` of them, of which the first `capacity`
 * are written. Where `count` is greater, ask again with room for all before they are forgotten. */
lightbvh_status lightbvh_removed_lights(const lightbvh *bvh, lightbvh_range *ranges, size_t capacity, size_t *count);
/* New lights may get those numbers from now on. */
lightbvh_status lightbvh_forget_removed_lights(lightbvh *bvh);

/* Questions. */

/* Chooses a light for a point by a uniform random number of 64 bits. */
lightbvh_status lightbvh_sample_light(const lightbvh *bvh, const lightbvh_point *point, uint64_t random,
                                      lightbvh_sample *sample);
/* As lightbvh_sample_light for `count` points with a number each; faster than one at a time. */
lightbvh_status lightbvh_sample_batch(const lightbvh *bvh, const lightbvh_point *points, const uint64_t *randoms,
                                      size_t count, lightbvh_sample *samples);
/* The probability of a light at a point: to the bit the one that comes with its sample; 0 where there is no such light. */
lightbvh_status lightbvh_pmf(const lightbvh *bvh, const lightbvh_point *point, uint32_t light, uint32_t instance,
                             float *pmf);
/* The numbers of an instance's lights: `count` from `first`, triangle by triangle of its mesh. LIGHTBVH_REFUSED where the
 * instance was removed: what keeps ids from frame to frame asks so. */
lightbvh_status lightbvh_lights_of(const lightbvh *bvh, lightbvh_instance instance, uint32_t *first, uint32_t *count);
/* A point on a light, uniform over its area where u and v are; numbers in [0, 1), others are a LIGHTBVH_BAD_POINT. */
lightbvh_status lightbvh_point_of(const lightbvh *bvh, uint32_t light, uint32_t instance, float u, float v,
                                  lightbvh_light_point *point);

#ifdef __cplusplus
}
#endif

#endif
