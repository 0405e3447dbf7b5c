/*
 * lightbvh for C and C++: samples one of many moving lights, with its exact probability.
 *
 * Lengths are metres, radiance is W/(m^2 sr) in linear RGB. A function that may fail returns a lightbvh_status;
 * lightbvh_last_error() then says in words what was wrong and what to do. A function that fails has changed nothing and
 * written nothing to its results. No function ends the program or lets a Rust panic out.
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
    /* An edit is refused: an id that is not in use, a number out of its range, a mesh in use, ... */
    LIGHTBVH_REFUSED = 2,
    /* A point is not within 2^40 m, or its normal is neither zero nor of length 1. */
    LIGHTBVH_BAD_POINT = 3,
    /* There is no light of that number in that instance. */
    LIGHTBVH_NO_LIGHT = 4,
    /* A defect of this library. A light BVH that was being changed then only can be freed. */
    LIGHTBVH_PANICKED = 5
} lightbvh_status;

/* A mesh. All zero is no mesh; an id of a removed mesh, or of another light BVH, is refused. */
typedef struct lightbvh_mesh {
    uint32_t tree, index, generation, kind;
} lightbvh_mesh;

/* An instance, as lightbvh_mesh. */
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
    uint32_t mesh;     /* what lightbvh_triangle_of returns: the index of the instance; ignored where triangles come in */
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

/* What the last function that failed on this thread had to say, in UTF-8; "" before any did. It stays until the next one
 * fails on this thread. Never null. */
const char *lightbvh_last_error(void);

/* A light BVH without lights, to be freed by lightbvh_free; null only where memory or the library fails. */
lightbvh *lightbvh_create(void);
/* Frees it. Null does nothing. */
void lightbvh_free(lightbvh *bvh);

/* Edits. Samples see them after the next lightbvh_refit. */

/* A new mesh of `count` triangles, at least one, in the mesh's own space. It is not in the world yet. */
lightbvh_status lightbvh_add_mesh(lightbvh *bvh, const lightbvh_triangle *triangles, size_t count, lightbvh_mesh *mesh);
/* Puts a mesh into the world. `radiance` is a factor on that of the mesh: 0, or from 2^-60 to 2^60. */
lightbvh_status lightbvh_add_instance(lightbvh *bvh, lightbvh_mesh mesh, const lightbvh_transform *transform,
                                      float radiance, lightbvh_instance *instance);
/* As lightbvh_add_instance for `count` places, all or none of them. One at a time takes time in proportion to all instances
 * there are, each time; together they take it once. */
lightbvh_status lightbvh_add_instances(lightbvh *bvh, lightbvh_mesh mesh, const lightbvh_transform *transforms,
                                       float radiance, size_t count, lightbvh_instance *instances);
lightbvh_status lightbvh_set_transform(lightbvh *bvh, lightbvh_instance instance, const lightbvh_transform *transform);
/* As the factor of lightbvh_add_instance; 0 turns the instance off. */
lightbvh_status lightbvh_set_radiance(lightbvh *bvh, lightbvh_instance instance, float radiance);
/* New vertices or radiance of a mesh, in all its instances: as many triangles as before. */
lightbvh_status lightbvh_set_triangles(lightbvh *bvh, lightbvh_mesh mesh, const lightbvh_triangle *triangles,
                                       size_t count);
/* The same for `count` triangles from index `first` of the mesh on: lightbvh_refit then computes what leads to them alone. */
lightbvh_status lightbvh_set_triangle_range(lightbvh *bvh, lightbvh_mesh mesh, uint32_t first,
                                            const lightbvh_triangle *triangles, size_t count);
lightbvh_status lightbvh_remove_instance(lightbvh *bvh, lightbvh_instance instance);
/* Removes a mesh that has no instances. */
lightbvh_status lightbvh_remove_mesh(lightbvh *bvh, lightbvh_mesh mesh);

/* Computes the nodes that the edits touched: once a frame. */
lightbvh_status lightbvh_refit(lightbvh *bvh);
/* Builds the top level anew, and meshes whose trees lost quality, and refits: once in a while, since refits alone make
 * samples of moving lights worse from frame to frame. It runs on this thread. */
lightbvh_status lightbvh_rebuild(lightbvh *bvh);

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
/* The triangle, in the world, that a sample names. */
lightbvh_status lightbvh_triangle_of(const lightbvh *bvh, uint32_t light, uint32_t instance,
                                     lightbvh_triangle *triangle);
/* The numbers of an instance's lights: `count` from `first`, triangle by triangle of its mesh. */
lightbvh_status lightbvh_lights_of(const lightbvh *bvh, lightbvh_instance instance, uint32_t *first, uint32_t *count);
/* A point on a light, uniform over its area where the numbers u and v are over [0, 1). */
lightbvh_status lightbvh_point_of(const lightbvh *bvh, uint32_t light, uint32_t instance, float u, float v,
                                  lightbvh_light_point *point);
/* How many lights there are: the triangles of all instances. */
lightbvh_status lightbvh_light_count(const lightbvh *bvh, size_t *count);

#ifdef __cplusplus
}
#endif

#endif
