// Functions of lightbvh (docs/shaders.md). Written by `print-functions` from compiled kernels; edits are lost.

struct LightbvhTree {
    uint root;
    uint trail_words;
    uint live;
    uint lights;
    uint depth;
    uint top;
    uint above;
    uint places;
    uint parts;
};
struct LightbvhInstance {
    uint root;
    uint blas;
    uint first;
    uint first_light;
    uint count;
    uint listed;
    float columns[3][3];
    float translation[3];
    float inverse_[3][3];
    float per_inverse;
    float flux;
    float radiance[3];
    uint mask;
    uint mirrored;
};
struct LightbvhType14_ {
    float member[3];
    float member_1[3];
};
struct LightbvhType16_ {
    LightbvhType14_ member;
    uint member_1[2];
};
struct LightbvhType19_ {
    uint member;
    uint member_1;
    float member_2;
};
struct LightbvhLightSample {
    uint light;
    uint instance;
    float pmf;
};
struct LightbvhType23_ {
    uint member;
    uint member_1;
};
struct LightbvhType24_ {
    LightbvhType23_ member;
    LightbvhType23_ member_1;
};
struct LightbvhType25_ {
    float member;
    float member_1;
};
struct LightbvhType26_ {
    LightbvhType24_ member;
    LightbvhType23_ member_1;
    LightbvhType14_ member_2;
    LightbvhType25_ member_3;
    uint member_4;
    uint member_5;
    uint member_6;
    uint member_7;
    uint member_8;
    uint member_9;
    uint member_10;
    uint member_11;
    bool member_12;
    bool member_13;
};
struct LightbvhType27_ {
    uint member;
    uint member_1;
    LightbvhType26_ member_2;
};
struct LightbvhType29_ {
    float member[3];
    float member_1[3];
    float member_2[3];
};
struct LightbvhType30_ {
    LightbvhType29_ member;
    uint member_1[2];
};
struct LightbvhType31_ {
    LightbvhType24_ member;
    LightbvhType23_ member_1;
    LightbvhType25_ member_2;
    uint member_3;
    uint member_4;
    uint member_5;
    uint member_6;
    uint member_7;
    uint member_8;
    uint member_9;
    LightbvhType29_ member_10;
    uint member_11;
    bool member_12;
    bool member_13;
};
struct LightbvhType32_ {
    uint member;
    uint member_1;
    LightbvhType31_ member_2;
};
struct LightbvhLight {
    float p[3][3];
    float radiance[3];
    uint mesh;
    uint flags;
};
struct LightbvhType38_ {
    float member[3];
    float member_1;
    float member_2[3];
    uint member_3;
    float member_4[3];
};
struct LightbvhLightPoint {
    vec3 p;
    float density;
    vec3 normal;
    uint flags;
    vec3 radiance;
};
layout(std140, set = 0, binding = 4) uniform LightbvhTree_block_0Compute { LightbvhTree lightbvh_tree; };

layout(std430, set = 0, binding = 0) readonly buffer LightbvhNodes_block_1Compute {
    uint list[][6][8];
} lightbvh_nodes;

layout(std430, set = 0, binding = 1) readonly buffer LightbvhInstances_block_2Compute {
    LightbvhInstance list[];
} lightbvh_instances;

layout(std430, set = 0, binding = 2) readonly buffer LightbvhTrails_block_3Compute {
    uint list[];
} lightbvh_trails;

layout(std430, set = 0, binding = 3) readonly buffer LightbvhLights_block_4Compute {
    LightbvhLight list[];
} lightbvh_lights;


LightbvhLightSample lightbvh_sample(vec3 p, vec3 n, uvec2 number) {
    LightbvhType16_ queries = LightbvhType16_(LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), uint[2](0u, 0u));
    LightbvhType19_ results = LightbvhType19_(0u, 0u, 0.0);
    float v0_[8] = float[8](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    uint v1_ = 0u;
    uint v2_ = 0u;
    uint v3_ = 0u;
    uint v4_ = 0u;
    uint v5_ = 0u;
    uint v6_ = 0u;
    uint v7_ = 0u;
    uint v8_ = 0u;
    uint v9_ = 0u;
    uint v10_ = 0u;
    uint v11_ = 0u;
    uint v12_ = 0u;
    bool v13_ = false;
    uint v14_ = 0u;
    uint v15_ = 0u;
    uint v16_ = 0u;
    bool v17_ = false;
    bool v18_ = false;
    LightbvhType24_ v19_ = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
    uint v20_ = 0u;
    uint v21_ = 0u;
    uint v22_ = 0u;
    uint v23_ = 0u;
    bool v24_ = false;
    uint v25_ = 0u;
    LightbvhType23_ v26_ = LightbvhType23_(0u, 0u);
    uint v27_ = 0u;
    uint v28_ = 0u;
    uint v29_ = 0u;
    LightbvhType23_ v30_ = LightbvhType23_(0u, 0u);
    uint v31_ = 0u;
    uint v32_ = 0u;
    LightbvhType23_ v33_ = LightbvhType23_(0u, 0u);
    uint v34_ = 0u;
    bool v35_ = false;
    bool v36_ = false;
    LightbvhType23_ v37_ = LightbvhType23_(0u, 0u);
    bool v38_ = false;
    LightbvhType24_ v39_ = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
    bool v40_ = false;
    LightbvhType24_ v41_ = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
    uint v42_ = 0u;
    uint v43_ = 0u;
    bool v44_ = false;
    LightbvhType27_ v45_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    bool v46_ = false;
    LightbvhType23_ v47_ = LightbvhType23_(0u, 0u);
    LightbvhType23_ v48_ = LightbvhType23_(0u, 0u);
    LightbvhType23_ v49_ = LightbvhType23_(0u, 0u);
    LightbvhType23_ v50_ = LightbvhType23_(0u, 0u);
    LightbvhType23_ v51_ = LightbvhType23_(0u, 0u);
    bool v52_ = false;
    uint v53_ = 0u;
    uint v54_ = 0u;
    uint v55_ = 0u;
    uint v56_ = 0u;
    int v57_ = 0;
    uint v58_ = 0u;
    bool v59_ = false;
    LightbvhType27_ v60_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    uint v61_ = 0u;
    uint v62_ = 0u;
    LightbvhType27_ v63_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    float v64_ = 0.0;
    float v65_ = 0.0;
    float v66_ = 0.0;
    float v67_ = 0.0;
    LightbvhType27_ v68_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    bool v69_ = false;
    LightbvhType27_ v70_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    bool v71_ = false;
    bool v72_ = false;
    LightbvhType27_ v73_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    LightbvhType27_ v74_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    LightbvhType27_ v75_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    LightbvhType27_ v76_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    uint v77_ = 0u;
    uint v78_ = 0u;
    LightbvhType27_ v79_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    LightbvhType27_ v80_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
    float v81_ = 0.0;
    uint v82_ = 0u;
    uint v83_ = 0u;
    bool v84_ = false;
    uint v85_ = 0u;
    int v86_ = 0;
    uint v87_ = 0u;
    int v88_ = 0;
    uint v89_ = 0u;
    uint v90_ = 0u;
    uint v91_ = 0u;
    uint v92_ = 0u;
    bool v93_ = false;
    uint v94_ = 0u;
    int v95_ = 0;
    uint v96_ = 0u;
    int v97_ = 0;
    uint v98_ = 0u;
    uint v99_ = 0u;
    uint v100_ = 0u;
    uint v101_ = 0u;
    bool v102_ = false;
    LightbvhType19_ v103_ = LightbvhType19_(0u, 0u, 0.0);
    queries = LightbvhType16_(LightbvhType14_(float[3](p.x, p.y, p.z), float[3](n.x, n.y, n.z)), uint[2](number.x, number.y));
    do {
        uint _e141 = uint(lightbvh_nodes.list.length());
        uint _e144 = uint(lightbvh_instances.list.length());
        uint _e147 = uint(lightbvh_trails.list.length());
        uint _e150 = lightbvh_tree.top;
        uint _e153 = lightbvh_tree.root;
        uint _e156 = lightbvh_tree.above;
        uint _e159 = lightbvh_tree.places;
        uint _e162 = lightbvh_tree.parts;
        uint _e165 = lightbvh_tree.trail_words;
        uint _e168 = lightbvh_tree.live;
        uint _e171 = lightbvh_tree.lights;
        uint _e174 = lightbvh_tree.depth;
        LightbvhType16_ _e176 = queries;
        v40_ = false;
        v41_ = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
        v42_ = 4294967295u;
        v43_ = 4294967295u;
        if (((_e176.member_1[0] >> 10u) < 65536u)) {
            uint _e191 = ((_e176.member_1[0] << 6u) | ((_e176.member_1[1] >> uint(1)) >> 25u));
            uint _e193 = (_e176.member_1[1] << 6u);
            bool _e194 = (_e168 > 0u);
            v1_ = 0u;
            v2_ = 0u;
            if (_e194) {
                uint _e247 = (_e193 >> uint(16));
                uint _e248 = (_e193 & 65535u);
                uint _e250 = (_e168 >> uint(16));
                uint _e251 = (_e168 & 65535u);
                uint _e256 = ((_e247 * _e251) + ((_e248 * _e251) >> uint(16)));
                uint _e267 = (_e193 * _e168);
                uint _e269 = (_e191 >> uint(16));
                uint _e270 = (_e191 & 65535u);
                uint _e275 = ((_e269 * _e251) + ((_e270 * _e251) >> uint(16)));
                uint _e286 = (_e191 * _e168);
                uint _e287 = (_e286 + (((_e247 * _e250) + (_e256 >> uint(16))) + (((_e248 * _e250) + (_e256 & 65535u)) >> uint(16))));
                uint _e290 = ((((_e269 * _e250) + (_e275 >> uint(16))) + (((_e270 * _e250) + (_e275 & 65535u)) >> uint(16))) + ((_e287 < _e286) ? 1u : 0u));
                bool _e291 = (_e290 < _e144);
                v7_ = 4294967295u;
                v8_ = 4294967295u;
                if (_e291) {
                    if (_e291) {
                    } else {
                        break;
                    }
                    uint _e294 = lightbvh_instances.list[_e290].listed;
                    bool _e295 = (_e294 < _e144);
                    v5_ = 4294967295u;
                    v6_ = 4294967295u;
                    if (_e295) {
                        if (_e295) {
                        } else {
                            break;
                        }
                        uint _e298 = lightbvh_instances.list[_e294].count;
                        bool _e299 = (_e298 > 0u);
                        v4_ = 4294967295u;
                        if (_e299) {
                            uint _e302 = lightbvh_instances.list[_e294].first;
                            uint _e304 = (_e267 >> uint(16));
                            uint _e305 = (_e267 & 65535u);
                            uint _e307 = (_e298 >> uint(16));
                            uint _e308 = (_e298 & 65535u);
                            uint _e313 = ((_e304 * _e308) + ((_e305 * _e308) >> uint(16)));
                            uint _e325 = (_e287 >> uint(16));
                            uint _e326 = (_e287 & 65535u);
                            uint _e331 = ((_e325 * _e308) + ((_e326 * _e308) >> uint(16)));
                            uint _e342 = (_e287 * _e298);
                            v4_ = (_e302 + ((((_e325 * _e307) + (_e331 >> uint(16))) + (((_e326 * _e307) + (_e331 & 65535u)) >> uint(16))) + (((_e342 + (((_e304 * _e307) + (_e313 >> uint(16))) + (((_e305 * _e307) + (_e313 & 65535u)) >> uint(16)))) < _e342) ? 1u : 0u)));
                        }
                        uint _e349 = v4_;
                        v5_ = _e349;
                        v6_ = (_e299 ? _e294 : 4294967295u);
                    }
                    uint _e352 = v5_;
                    uint _e354 = v6_;
                    v7_ = _e352;
                    v8_ = _e354;
                }
                uint _e356 = v7_;
                uint _e358 = v8_;
                v1_ = _e356;
                v2_ = _e358;
            }
            uint _e196 = v1_;
            uint _e198 = v2_;
            v9_ = _e196;
            v10_ = _e198;
            if (_e194) {
            } else {
                v3_ = 4294967295u;
                if ((_e171 > 0u)) {
                    uint _e201 = (_e193 >> uint(16));
                    uint _e202 = (_e193 & 65535u);
                    uint _e204 = (_e171 >> uint(16));
                    uint _e205 = (_e171 & 65535u);
                    uint _e210 = ((_e201 * _e205) + ((_e202 * _e205) >> uint(16)));
                    uint _e222 = (_e191 >> uint(16));
                    uint _e223 = (_e191 & 65535u);
                    uint _e228 = ((_e222 * _e205) + ((_e223 * _e205) >> uint(16)));
                    uint _e239 = (_e191 * _e171);
                    v3_ = ((((_e222 * _e204) + (_e228 >> uint(16))) + (((_e223 * _e204) + (_e228 & 65535u)) >> uint(16))) + (((_e239 + (((_e201 * _e204) + (_e210 >> uint(16))) + (((_e202 * _e204) + (_e210 & 65535u)) >> uint(16)))) < _e239) ? 1u : 0u));
                }
                uint _e245 = v3_;
                v9_ = _e245;
                v10_ = 4294967295u;
            }
            uint _e360 = v9_;
            uint _e362 = v10_;
            bool _e363 = (_e362 < _e144);
            v12_ = 0u;
            v13_ = true;
            if (_e363) {
                v11_ = 0u;
                if (_e194) {
                    if (_e363) {
                    } else {
                        break;
                    }
                    uint _e366 = lightbvh_instances.list[_e362].first;
                    uint _e370 = lightbvh_instances.list[_e362].first_light;
                    v11_ = ((_e360 - _e366) + _e370);
                }
                uint _e373 = v11_;
                v12_ = _e373;
                v13_ = (_e194 ? false : true);
            }
            uint _e376 = v12_;
            bool _e378 = v13_;
            uint _e380 = ((_e378 ? _e360 : _e376) * _e165);
            bool _e381 = (_e380 < _e147);
            v14_ = 0u;
            if (_e381) {
                if (_e381) {
                } else {
                    break;
                }
                uint _e383 = lightbvh_trails.list[_e380];
                v14_ = _e383;
            }
            uint _e385 = v14_;
            v16_ = 0u;
            v17_ = true;
            if ((_e165 == 2u)) {
                uint _e387 = (_e380 + 1u);
                bool _e388 = (_e387 < _e147);
                v15_ = 0u;
                if (_e388) {
                    if (_e388) {
                    } else {
                        break;
                    }
                    uint _e390 = lightbvh_trails.list[_e387];
                    v15_ = _e390;
                }
                uint _e392 = v15_;
                v16_ = _e392;
                v17_ = (_e388 ? false : true);
            }
            uint _e395 = v16_;
            bool _e397 = v17_;
            uint _e398 = (_e397 ? 0u : _e395);
            v18_ = false;
            v19_ = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
            if (_e363) {
                uint _e405 = (_e159 + _e362);
                bool _e406 = (_e405 < _e147);
                v20_ = 4294967295u;
                if (_e406) {
                    if (_e406) {
                    } else {
                        break;
                    }
                    uint _e408 = lightbvh_trails.list[_e405];
                    v20_ = _e408;
                }
                uint _e410 = v20_;
                v23_ = 0u;
                v24_ = true;
                if ((_e410 != 4294967295u)) {
                    bool _e412 = (_e410 >= 2147483648u);
                    v22_ = 0u;
                    if (_e412) {
                        uint _e416 = (_e162 + ((_e410 - 2147483648u) + (_e385 & 7u)));
                        bool _e417 = (_e416 < _e147);
                        v21_ = 4294967295u;
                        if (_e417) {
                            if (_e417) {
                            } else {
                                break;
                            }
                            uint _e419 = lightbvh_trails.list[_e416];
                            v21_ = _e419;
                        }
                        uint _e421 = v21_;
                        v22_ = _e421;
                    }
                    uint _e423 = v22_;
                    v23_ = _e423;
                    v24_ = (_e412 ? false : true);
                }
                uint _e426 = v23_;
                bool _e428 = v24_;
                v25_ = 0u;
                v26_ = LightbvhType23_(0u, 0u);
                v27_ = (_e428 ? _e410 : _e426);
                bool loop_init = true;
                while(true) {
                    if (!loop_init) {
                        v25_ = v32_;
                        v26_ = v33_;
                        v27_ = v34_;
                        v36_ = false;
                        if (!(v35_)) {
                            break;
                        }
                    }
                    loop_init = false;
                    uint _e431 = v25_;
                    LightbvhType23_ _e433 = v26_;
                    uint _e435 = v27_;
                    v37_ = _e433;
                    v32_ = 0u;
                    v33_ = LightbvhType23_(0u, 0u);
                    v34_ = 0u;
                    v35_ = false;
                    if ((_e435 < 2147483648u)) {
                        bool _e437 = (_e431 < 20u);
                        v29_ = 0u;
                        v30_ = LightbvhType23_(0u, 0u);
                        v31_ = 0u;
                        if (_e437) {
                            uint _e456 = (_e156 + (_e435 >> 3u));
                            bool _e457 = (_e456 < _e147);
                            v28_ = 4294967295u;
                            if (_e457) {
                                if (_e457) {
                                } else {
                                    v36_ = true;
                                    break;
                                }
                                uint _e459 = lightbvh_trails.list[_e456];
                                v28_ = _e459;
                            }
                            uint _e461 = v28_;
                            v29_ = (_e431 + 1u);
                            v30_ = LightbvhType23_((((_e433.member << 3u) | ((_e435 & 7u) & 7u)) & 1073741823u), (((_e433.member_1 << 3u) | ((_e433.member >> 27u) & 7u)) & 1073741823u));
                            v31_ = _e461;
                        }
                        uint _e464 = v29_;
                        LightbvhType23_ _e466 = v30_;
                        uint _e468 = v31_;
                        v32_ = _e464;
                        v33_ = _e466;
                        v34_ = _e468;
                        v35_ = _e437;
                    }
                    uint _e470 = v32_;
                    LightbvhType23_ _e472 = v33_;
                    uint _e474 = v34_;
                    bool _e476 = v35_;
                    continue;
                }
                bool _e479 = v36_;
                if (_e479) {
                    break;
                }
                LightbvhType23_ _e482 = v37_;
                v18_ = _e479;
                v19_ = LightbvhType24_(_e482, LightbvhType23_(_e385, _e398));
            }
            bool _e400 = v18_;
            LightbvhType24_ _e402 = v19_;
            v38_ = _e400;
            v39_ = _e402;
            if (_e363) {
            } else {
                v38_ = false;
                v39_ = LightbvhType24_(LightbvhType23_(_e385, _e398), LightbvhType23_(0u, 0u));
            }
            bool _e485 = v38_;
            LightbvhType24_ _e487 = v39_;
            v40_ = _e485;
            v41_ = _e487;
            v42_ = _e362;
            v43_ = _e360;
        }
        bool _e489 = v40_;
        LightbvhType24_ _e491 = v41_;
        uint _e493 = v42_;
        uint _e495 = v43_;
        bool _e498 = (_e174 == 0u);
        LightbvhType26_ _e500 = LightbvhType26_(_e491, LightbvhType23_(_e176.member_1[0], _e176.member_1[1]), _e176.member, LightbvhType25_(0.0, 1.0), 0u, (_e153 + _e150), 4294967295u, 4294967295u, 0u, 4194304u, 0u, _e174, _e498, (_e495 != 4294967295u));
        uint _e503 = (uint(21) - uint(findMSB(4128767u)));
        uint _e505 = ((_e503 < 22u) ? _e503 : 22u);
        uint _e513 = (_e505 & 31u);
        LightbvhType26_ _e534 = LightbvhType26_(_e500.member, LightbvhType23_((((_e176.member_1[0] - 67108864u) << _e513) | ((_e176.member_1[1] >> uint(1)) >> ((31u - _e505) & 31u))), (_e176.member_1[1] << _e513)), _e500.member_2, _e500.member_3, _e500.member_4, _e500.member_5, _e500.member_6, _e500.member_7, _e500.member_8, _e500.member_9, _e500.member_10, _e500.member_11, _e500.member_12, _e500.member_13);
        LightbvhType26_ _e551 = LightbvhType26_(_e534.member, _e534.member_1, _e534.member_2, _e534.member_3, _e534.member_4, _e534.member_5, _e534.member_6, _e534.member_7, _e534.member_8, (4128768u << _e513), _e534.member_10, _e534.member_11, _e534.member_12, _e534.member_13);
        v44_ = _e489;
        v45_ = LightbvhType27_(_e495, _e493, LightbvhType26_(_e551.member, _e551.member_1, _e551.member_2, _e551.member_3, _e551.member_4, _e551.member_5, _e551.member_6, _e551.member_7, _e551.member_8, _e551.member_9, _e505, _e551.member_11, _e551.member_12, _e551.member_13));
        v46_ = _e498;
        bool loop_init_1 = true;
        while(true) {
            if (!loop_init_1) {
                v44_ = v69_;
                v45_ = v70_;
                v46_ = v71_;
                v72_ = v69_;
                if (!((v46_ ? false : true))) {
                    break;
                }
            }
            loop_init_1 = false;
            bool _e569 = v44_;
            LightbvhType27_ _e571 = v45_;
            bool _e573 = v46_;
            v73_ = _e571;
            v74_ = _e571;
            v75_ = _e571;
            v76_ = _e571;
            v79_ = _e571;
            v80_ = _e571;
            v69_ = _e569;
            v70_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
            v71_ = false;
            if (_e573) {
            } else {
                bool _e576 = (_e571.member_2.member_5 < _e141);
                uint _e577 = (_e576 ? _e571.member_2.member_5 : 0u);
                if ((_e577 < _e141)) {
                } else {
                    v72_ = true;
                    break;
                }
                uint _e606 = lightbvh_nodes.list[_e577][0u][3u];
                int _e609 = (int((_e606 & 255u)) - 127);
                uint _e620 = lightbvh_nodes.list[_e577][0u][0u];
                uint _e625 = lightbvh_nodes.list[_e577][0u][1u];
                uint _e630 = lightbvh_nodes.list[_e577][0u][2u];
                float _e632 = (uintBitsToFloat(_e620) - _e571.member_2.member_2.member[0]);
                float _e633 = (uintBitsToFloat(_e625) - _e571.member_2.member_2.member[1]);
                float _e634 = (uintBitsToFloat(_e630) - _e571.member_2.member_2.member[2]);
                float _e637 = uintBitsToFloat((floatBitsToUint(_e632) & 2147483647u));
                float _e640 = uintBitsToFloat((floatBitsToUint(_e633) & 2147483647u));
                float _e643 = uintBitsToFloat((floatBitsToUint(_e634) & 2147483647u));
                float _e645 = ((_e637 > _e640) ? _e637 : _e640);
                int _e653 = (int(((floatBitsToUint(((_e645 > _e643) ? _e645 : _e643)) >> uint(23)) & 255u)) - 127);
                int _e655 = ((_e653 > _e609) ? _e653 : _e609);
                int _e656 = (_e609 - _e655);
                int _e658 = ((_e656 < -40) ? -40 : _e656);
                int _e659 = -(_e655);
                int _e661 = ((_e659 < -126) ? -126 : _e659);
                float _e668 = uintBitsToFloat((uint((((_e661 > 127) ? 127 : _e661) + 127)) << uint(23)));
                int _e673 = ((_e658 < -126) ? -126 : _e658);
                float _e680 = uintBitsToFloat((uint((((_e673 > 127) ? 127 : _e673) + 127)) << uint(23)));
                float _e681 = (_e680 * 4.656613e-10);
                float _e693 = (2.0 * 8.0);
                float _e694 = (uintBitsToFloat((floatBitsToUint(_e571.member_2.member_2.member_1[0]) & 2147483647u)) * _e693);
                float _e695 = (uintBitsToFloat((floatBitsToUint(_e571.member_2.member_2.member_1[1]) & 2147483647u)) * _e693);
                float _e696 = (uintBitsToFloat((floatBitsToUint(_e571.member_2.member_2.member_1[2]) & 2147483647u)) * _e693);
                v0_ = float[8](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
                v47_ = LightbvhType23_(0u, 8u);
                bool loop_init_2 = true;
                while(true) {
                    if (!loop_init_2) {
                        v47_ = v50_;
                        v52_ = _e569;
                        if (!((int(v51_.member) != 0))) {
                            break;
                        }
                    }
                    loop_init_2 = false;
                    LightbvhType23_ _e703 = v47_;
                    bool _e706 = (_e703.member < _e703.member_1);
                    v48_ = LightbvhType23_(0u, 0u);
                    v49_ = LightbvhType23_(0u, 0u);
                    if (_e706) {
                        v48_ = LightbvhType23_((_e703.member + 1u), _e703.member_1);
                        v49_ = LightbvhType23_(1u, _e703.member);
                    }
                    LightbvhType23_ _e708 = v48_;
                    LightbvhType23_ _e710 = v49_;
                    v50_ = _e708;
                    v51_ = _e710;
                    if (_e706) {
                    } else {
                        v50_ = _e703;
                        v51_ = LightbvhType23_(0u, LightbvhType23_(0u, 0u).member_1);
                    }
                    LightbvhType23_ _e720 = v50_;
                    LightbvhType23_ _e722 = v51_;
                    bool _e726 = (int(_e722.member) != 0);
                    if (_e726) {
                        bool _e727 = (_e722.member_1 < 8u);
                        if (_e727) {
                        } else {
                            v52_ = true;
                            break;
                        }
                        uint _e731 = lightbvh_nodes.list[_e577][1u][_e722.member_1];
                        if (_e727) {
                        } else {
                            v52_ = true;
                            break;
                        }
                        uint _e735 = lightbvh_nodes.list[_e577][2u][_e722.member_1];
                        if (_e727) {
                        } else {
                            v52_ = true;
                            break;
                        }
                        uint _e739 = lightbvh_nodes.list[_e577][3u][_e722.member_1];
                        if (_e727) {
                        } else {
                            v52_ = true;
                            break;
                        }
                        uint _e743 = lightbvh_nodes.list[_e577][4u][_e722.member_1];
                        float _e759 = ((_e632 * _e668) + (float(int(_e731)) * _e681));
                        float _e760 = ((_e633 * _e668) + (float(int((_e731 << 15u))) * _e681));
                        float _e761 = ((_e634 * _e668) + (float(int(_e735)) * _e681));
                        float _e766 = uintBitsToFloat((((_e743 << 20u) & 267386880u) + (floatBitsToUint(_e680) + 4043309056u)));
                        float _e771 = (float(int((_e735 << 15u))) * 4.656613e-10);
                        float _e773 = float(int(_e739));
                        float _e777 = float(int((_e739 << 8u)));
                        float _e781 = float(int((_e739 << 16u)));
                        float _e785 = (float(int((_e739 & 255u))) * 0.003921569);
                        float _e802 = (_e766 * _e766);
                        float _e808 = ((((_e759 * _e759) + (_e760 * _e760)) + (_e761 * _e761)) + 8.881784e-16);
                        float _e812 = (_e808 + (1.25 * _e802));
                        float _e817 = uintBitsToFloat((1595932665u - (floatBitsToUint(_e812) >> uint(1))));
                        float _e822 = (_e817 * (0.70395225 * (2.3892446 - (_e812 * (_e817 * _e817)))));
                        float _e823 = (_e766 * _e822);
                        float _e828 = ((((_e571.member_2.member_2.member_1[0] * 4.656613e-10) * _e773) + ((_e571.member_2.member_2.member_1[1] * 4.656613e-10) * _e777)) + ((_e571.member_2.member_2.member_1[2] * 4.656613e-10) * _e781));
                        float _e833 = (0.03162278 + (_e823 * (1.0 + (_e771 * (_e828 * _e828)))));
                        float _e839 = (((((_e571.member_2.member_2.member_1[0] + _e571.member_2.member_2.member_1[0]) * _e759) + ((_e571.member_2.member_2.member_1[1] + _e571.member_2.member_2.member_1[1]) * _e760)) + ((_e571.member_2.member_2.member_1[2] + _e571.member_2.member_2.member_1[2]) * _e761)) * _e822);
                        float _e841 = (_e839 + ((((_e694 + _e695) + _e696) + ((((_e694 * 4.656613e-10) * float(int(_e743))) + ((_e695 * 4.656613e-10) * float(int((_e743 << 8u))))) + ((_e696 * 4.656613e-10) * float(int((_e743 << 16u)))))) * _e823));
                        float _e843 = ((_e841 > 0.0001) ? _e841 : 0.0001);
                        float _e849 = (uintBitsToFloat((floatBitsToUint(_e839) & 2147483647u)) + _e833);
                        float _e855 = (1.0 + _e771);
                        float _e861 = ((((_e773 * _e759) + (_e777 * _e760)) + (_e781 * _e761)) * (-2.0 * 4.656613e-10));
                        float _e864 = (_e766 * ((_e855 > _e785) ? _e855 : _e785));
                        float _e866 = (_e808 - (2.5 * _e802));
                        float _e868 = (0.25 * (_e861 * _e861));
                        float _e874 = ((((_e866 > _e868) ? _e866 : _e868) + 8.881784e-16) + (1.25 * (_e864 * _e864)));
                        float _e879 = uintBitsToFloat((1595932665u - (floatBitsToUint(_e874) >> uint(1))));
                        float _e884 = (_e879 * (0.70395225 * (2.3892446 - (_e874 * (_e879 * _e879)))));
                        float _e886 = ((_e766 * _e884) * _e855);
                        float _e890 = ((0.03162278 + _e886) + (_e785 * (0.5 - _e886)));
                        float _e891 = (_e861 * _e884);
                        float _e895 = (uintBitsToFloat((floatBitsToUint(_e891) & 2147483647u)) + _e890);
                        float _e904 = ((_e849 * _e895) * (_e808 + (0.5 * _e802)));
                        float _e907 = uintBitsToFloat((2129859015u - floatBitsToUint(_e904)));
                        if (_e727) {
                        } else {
                            v52_ = true;
                            break;
                        }
                        v0_[_e722.member_1] = ((uintBitsToFloat(((_e735 & 2047u) << 19u)) * (((((_e839 > 0.0) ? _e839 : 0.0) * _e849) + (_e833 * ((_e843 < _e833) ? _e843 : _e833))) * ((((_e891 > 0.0) ? _e891 : 0.0) * _e895) + (_e890 * _e890)))) * (_e907 * (2.0 - (_e904 * _e907))));
                    }
                    continue;
                }
                bool _e915 = v52_;
                v72_ = _e915;
                if (_e915) {
                    break;
                }
                float _e916[8] = v0_;
                bool _e938 = (_e571.member_2.member_8 < 20u);
                v53_ = 0u;
                if (_e938) {
                    bool _e961 = (_e571.member_2.member_8 < 10u);
                    v55_ = _e571.member_2.member_8;
                    if (_e961) {
                    } else {
                        v55_ = (_e571.member_2.member_8 - 10u);
                    }
                    uint _e964 = v55_;
                    v53_ = (((_e961 ? _e571.member_2.member.member.member : _e571.member_2.member.member.member_1) >> (((_e964 * 3u) & 31u) & 31u)) & 7u);
                }
                uint _e940 = v53_;
                v56_ = _e940;
                if (_e938) {
                } else {
                    uint _e945 = (_e571.member_2.member_8 - 20u);
                    bool _e946 = (_e945 < 10u);
                    v54_ = _e945;
                    if (_e946) {
                    } else {
                        v54_ = (_e571.member_2.member_8 - 30u);
                    }
                    uint _e949 = v54_;
                    v56_ = (((_e946 ? _e571.member_2.member.member_1.member : _e571.member_2.member.member_1.member_1) >> (((_e949 * 3u) & 31u) & 31u)) & 7u);
                }
                uint _e973 = v56_;
                uint _e978 = (0u - ((_e916[1] > 0.0) ? 1u : 0u));
                uint _e979 = (1u & _e978);
                uint _e983 = (0u - ((_e916[2] > 0.0) ? 1u : 0u));
                uint _e986 = (_e979 ^ ((2u ^ _e979) & _e983));
                uint _e990 = (0u - ((_e916[3] > 0.0) ? 1u : 0u));
                uint _e993 = (_e986 ^ ((3u ^ _e986) & _e990));
                uint _e997 = (0u - ((_e916[4] > 0.0) ? 1u : 0u));
                uint _e1000 = (_e993 ^ ((4u ^ _e993) & _e997));
                uint _e1004 = (0u - ((_e916[5] > 0.0) ? 1u : 0u));
                uint _e1007 = (_e1000 ^ ((5u ^ _e1000) & _e1004));
                uint _e1011 = (0u - ((_e916[6] > 0.0) ? 1u : 0u));
                uint _e1014 = (_e1007 ^ ((6u ^ _e1007) & _e1011));
                uint _e1018 = (0u - ((_e916[7] > 0.0) ? 1u : 0u));
                uint _e1021 = (_e1014 ^ ((7u ^ _e1014) & _e1018));
                float _e1024 = ((((0.0 + _e916[0]) + _e916[4]) + ((0.0 + _e916[2]) + _e916[6])) + (((0.0 + _e916[1]) + _e916[5]) + ((0.0 + _e916[3]) + _e916[7])));
                bool _e1025 = (_e1024 > 0.0);
                float _e1029 = (_e1025 ? _e1024 : 1.0);
                uint _e1030 = floatBitsToUint(_e1029);
                float _e1035 = uintBitsToFloat(((_e1030 & 2147483648u) | (2129859015u - (_e1030 & 2147483647u))));
                float _e1038 = (_e1035 * (2.0 - (_e1029 * _e1035)));
                float _e1042 = ((float(int(_e571.member_2.member_9)) * 0.9999695) * (_e1038 * (2.0 - (_e1029 * _e1038))));
                v57_ = 2147483647;
                if (_e571.member_2.member_13) {
                } else {
                    v57_ = int((_e571.member_2.member_1.member >> 10u));
                }
                int _e1045 = v57_;
                int _e1051 = int((floatBitsToUint(((_e916[0] * _e1042) + 8388608.0)) & 8388607u));
                int _e1058 = (((_e1051 > 1) ? _e1051 : 1) & int((0u - ((_e916[0] > 0.0) ? 1u : 0u))));
                uint _e1059 = uint(_e1058);
                uint _e1060 = (_e1059 & 4294967295u);
                int _e1062 = int((_e571.member_2.member_13 ? _e973 : _e1021));
                uint _e1066 = (0u - (((_e1058 <= _e1045) && (0 < _e1062)) ? 1u : 0u));
                uint _e1067 = (_e1059 & _e1066);
                int _e1073 = int((floatBitsToUint(((_e916[1] * _e1042) + 8388608.0)) & 8388607u));
                int _e1078 = (_e1058 + (((_e1073 > 1) ? _e1073 : 1) & int(_e978)));
                uint _e1079 = uint(_e1078);
                uint _e1082 = (_e1060 ^ ((_e1079 ^ _e1060) & _e1066));
                uint _e1087 = (0u - (((_e1078 <= _e1045) && (1 < _e1062)) ? 1u : 0u));
                uint _e1090 = (_e1067 ^ ((_e1079 ^ _e1067) & _e1087));
                int _e1097 = int((floatBitsToUint(((_e916[2] * _e1042) + 8388608.0)) & 8388607u));
                int _e1102 = (_e1078 + (((_e1097 > 1) ? _e1097 : 1) & int(_e983)));
                uint _e1103 = uint(_e1102);
                uint _e1106 = (_e1082 ^ ((_e1103 ^ _e1082) & _e1087));
                uint _e1111 = (0u - (((_e1102 <= _e1045) && (2 < _e1062)) ? 1u : 0u));
                uint _e1114 = (_e1090 ^ ((_e1103 ^ _e1090) & _e1111));
                int _e1121 = int((floatBitsToUint(((_e916[3] * _e1042) + 8388608.0)) & 8388607u));
                int _e1126 = (_e1102 + (((_e1121 > 1) ? _e1121 : 1) & int(_e990)));
                uint _e1127 = uint(_e1126);
                uint _e1130 = (_e1106 ^ ((_e1127 ^ _e1106) & _e1111));
                uint _e1135 = (0u - (((_e1126 <= _e1045) && (3 < _e1062)) ? 1u : 0u));
                uint _e1138 = (_e1114 ^ ((_e1127 ^ _e1114) & _e1135));
                int _e1145 = int((floatBitsToUint(((_e916[4] * _e1042) + 8388608.0)) & 8388607u));
                int _e1150 = (_e1126 + (((_e1145 > 1) ? _e1145 : 1) & int(_e997)));
                uint _e1151 = uint(_e1150);
                uint _e1154 = (_e1130 ^ ((_e1151 ^ _e1130) & _e1135));
                uint _e1159 = (0u - (((_e1150 <= _e1045) && (4 < _e1062)) ? 1u : 0u));
                uint _e1162 = (_e1138 ^ ((_e1151 ^ _e1138) & _e1159));
                int _e1169 = int((floatBitsToUint(((_e916[5] * _e1042) + 8388608.0)) & 8388607u));
                int _e1174 = (_e1150 + (((_e1169 > 1) ? _e1169 : 1) & int(_e1004)));
                uint _e1175 = uint(_e1174);
                uint _e1178 = (_e1154 ^ ((_e1175 ^ _e1154) & _e1159));
                uint _e1183 = (0u - (((_e1174 <= _e1045) && (5 < _e1062)) ? 1u : 0u));
                uint _e1186 = (_e1162 ^ ((_e1175 ^ _e1162) & _e1183));
                int _e1193 = int((floatBitsToUint(((_e916[6] * _e1042) + 8388608.0)) & 8388607u));
                int _e1198 = (_e1174 + (((_e1193 > 1) ? _e1193 : 1) & int(_e1011)));
                uint _e1199 = uint(_e1198);
                uint _e1202 = (_e1178 ^ ((_e1199 ^ _e1178) & _e1183));
                uint _e1207 = (0u - (((_e1198 <= _e1045) && (6 < _e1062)) ? 1u : 0u));
                uint _e1210 = (_e1186 ^ ((_e1199 ^ _e1186) & _e1207));
                int _e1217 = int((floatBitsToUint(((_e916[7] * _e1042) + 8388608.0)) & 8388607u));
                int _e1222 = (_e1198 + (((_e1217 > 1) ? _e1217 : 1) & int(_e1018)));
                uint _e1223 = uint(_e1222);
                uint _e1226 = (_e1202 ^ ((_e1223 ^ _e1202) & _e1207));
                uint _e1231 = (0u - (((_e1222 <= _e1045) && (7 < _e1062)) ? 1u : 0u));
                uint _e1234 = (_e1210 ^ ((_e1223 ^ _e1210) & _e1231));
                uint _e1237 = (_e571.member_2.member_13 ? _e973 : ((((((((_e1066 & 1u) + (_e1087 & 1u)) + (_e1111 & 1u)) + (_e1135 & 1u)) + (_e1159 & 1u)) + (_e1183 & 1u)) + (_e1207 & 1u)) + (_e1231 & 1u)));
                bool _e1242 = (_e1237 < 8u);
                bool _e1243 = ((_e1025 && (_e1226 > _e1234)) && _e1242);
                uint _e1244 = (_e1242 ? _e1237 : 0u);
                v58_ = 0u;
                if (_e1243) {
                    v58_ = (((_e1237 == _e1021) ? _e571.member_2.member_9 : _e1226) - _e1234);
                }
                uint _e1248 = v58_;
                bool _e1249 = (_e1244 < 8u);
                if (_e1249) {
                } else {
                    v72_ = true;
                    break;
                }
                uint _e1253 = lightbvh_nodes.list[_e577][1u][_e1244];
                uint _e1254 = (_e1253 & 3u);
                if (_e1249) {
                } else {
                    v72_ = true;
                    break;
                }
                uint _e1258 = lightbvh_nodes.list[_e577][5u][_e1244];
                bool _e1262 = ((_e576 && (_e1248 > 0u)) && (_e1248 <= _e571.member_2.member_9));
                uint _e1263 = (_e1262 ? _e1248 : 1u);
                uint _e1265 = ((_e1263 - 1u) & 4194303u);
                uint _e1271 = (((_e1265 == 0u) ? 32u : (uint(31) - uint(findMSB(_e1265)))) - 10u);
                uint _e1273 = ((_e1271 < 22u) ? _e1271 : 22u);
                uint _e1286 = (_e1273 & 31u);
                LightbvhType27_ _e1311 = LightbvhType27_(_e571.member, _e571.member_1, LightbvhType26_(_e571.member_2.member, LightbvhType23_((((_e571.member_2.member_1.member - ((_e1243 ? _e1234 : 0u) << 10u)) << _e1286) | ((_e571.member_2.member_1.member_1 >> uint(1)) >> ((31u - _e1273) & 31u))), (_e571.member_2.member_1.member_1 << _e1286)), _e571.member_2.member_2, _e571.member_2.member_3, _e571.member_2.member_4, _e571.member_2.member_5, _e571.member_2.member_6, _e571.member_2.member_7, _e571.member_2.member_8, _e571.member_2.member_9, _e571.member_2.member_10, _e571.member_2.member_11, _e571.member_2.member_12, _e571.member_2.member_13));
                LightbvhType27_ _e1332 = LightbvhType27_(_e1311.member, _e1311.member_1, LightbvhType26_(_e1311.member_2.member, _e1311.member_2.member_1, _e1311.member_2.member_2, _e1311.member_2.member_3, _e1311.member_2.member_4, _e1311.member_2.member_5, _e1311.member_2.member_6, _e1311.member_2.member_7, _e1311.member_2.member_8, (_e1263 << _e1286), _e1311.member_2.member_10, _e1311.member_2.member_11, _e1311.member_2.member_12, _e1311.member_2.member_13));
                LightbvhType27_ _e1354 = LightbvhType27_(_e1332.member, _e1332.member_1, LightbvhType26_(_e1332.member_2.member, _e1332.member_2.member_1, _e1332.member_2.member_2, _e1332.member_2.member_3, _e1332.member_2.member_4, _e1332.member_2.member_5, _e1332.member_2.member_6, _e1332.member_2.member_7, _e1332.member_2.member_8, _e1332.member_2.member_9, (_e571.member_2.member_10 + _e1273), _e1332.member_2.member_11, _e1332.member_2.member_12, _e1332.member_2.member_13));
                uint _e1355 = (_e571.member_2.member_8 + 1u);
                v59_ = true;
                if ((_e1355 == 20u)) {
                } else {
                    v59_ = (_e1355 == 40u);
                }
                bool _e1359 = v59_;
                uint _e1360 = (_e1258 & 134217727u);
                uint _e1364 = (_e1258 >> (uint(findLSB(134217728u)) & 31u));
                bool _e1368 = (_e1360 < _e144);
                bool _e1369 = (((_e1262 && (_e1254 == 3u)) && _e938) && _e1368);
                bool _e1373 = ((_e1262 && (_e1254 == 1u)) && !(_e1359));
                LightbvhType27_ _e1395 = LightbvhType27_(_e1354.member, _e1354.member_1, LightbvhType26_(_e1354.member_2.member, _e1354.member_2.member_1, _e1354.member_2.member_2, _e1354.member_2.member_3, _e1354.member_2.member_4, _e1354.member_2.member_5, ((_e1262 && (_e1254 == 2u)) ? _e1258 : 4294967295u), _e1354.member_2.member_7, _e1354.member_2.member_8, _e1354.member_2.member_9, _e1354.member_2.member_10, _e1354.member_2.member_11, _e1354.member_2.member_12, _e1354.member_2.member_13));
                uint _e1398 = (_e571.member_2.member_11 - 1u);
                LightbvhType27_ _e1417 = LightbvhType27_(_e1395.member, _e1395.member_1, LightbvhType26_(_e1395.member_2.member, _e1395.member_2.member_1, _e1395.member_2.member_2, _e1395.member_2.member_3, _e1395.member_2.member_4, _e1395.member_2.member_5, _e1395.member_2.member_6, _e1395.member_2.member_7, _e1395.member_2.member_8, _e1395.member_2.member_9, _e1395.member_2.member_10, _e1398, _e1395.member_2.member_12, _e1395.member_2.member_13));
                bool _e1421 = (!((_e1369 || _e1373)) || (_e1398 == 0u));
                LightbvhType27_ _e1440 = LightbvhType27_(_e1417.member, _e1417.member_1, LightbvhType26_(_e1417.member_2.member, _e1417.member_2.member_1, _e1417.member_2.member_2, _e1417.member_2.member_3, _e1417.member_2.member_4, _e1417.member_2.member_5, _e1417.member_2.member_6, _e1417.member_2.member_7, _e1417.member_2.member_8, _e1417.member_2.member_9, _e1417.member_2.member_10, _e1417.member_2.member_11, _e1421, _e1417.member_2.member_13));
                v60_ = LightbvhType27_(0u, 0u, LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false));
                if (_e1369) {
                    if (_e1368) {
                    } else {
                        v72_ = true;
                        break;
                    }
                    LightbvhType27_ _e1505 = LightbvhType27_(_e1440.member, _e1440.member_1, LightbvhType26_(_e1440.member_2.member, _e1440.member_2.member_1, _e1440.member_2.member_2, _e1440.member_2.member_3, _e1440.member_2.member_4, _e1440.member_2.member_5, _e1440.member_2.member_6, _e1360, _e1440.member_2.member_8, _e1440.member_2.member_9, _e1440.member_2.member_10, _e1440.member_2.member_11, _e1440.member_2.member_12, _e1440.member_2.member_13));
                    uint _e1508 = lightbvh_instances.list[_e1360].root;
                    LightbvhType27_ _e1527 = LightbvhType27_(_e1505.member, _e1505.member_1, LightbvhType26_(_e1505.member_2.member, _e1505.member_2.member_1, _e1505.member_2.member_2, _e1505.member_2.member_3, _e1505.member_2.member_4, _e1508, _e1505.member_2.member_6, _e1505.member_2.member_7, _e1505.member_2.member_8, _e1505.member_2.member_9, _e1505.member_2.member_10, _e1505.member_2.member_11, _e1505.member_2.member_12, _e1505.member_2.member_13));
                    bool _e1528 = (_e1508 == 4294967295u);
                    v62_ = 4294967295u;
                    if (_e1528) {
                        uint _e1531 = lightbvh_instances.list[_e1360].first_light;
                        v62_ = _e1531;
                    }
                    uint _e1533 = v62_;
                    LightbvhType27_ _e1552 = LightbvhType27_(_e1527.member, _e1527.member_1, LightbvhType26_(_e1527.member_2.member, _e1527.member_2.member_1, _e1527.member_2.member_2, _e1527.member_2.member_3, _e1527.member_2.member_4, _e1527.member_2.member_5, _e1533, _e1527.member_2.member_7, _e1527.member_2.member_8, _e1527.member_2.member_9, _e1527.member_2.member_10, _e1527.member_2.member_11, _e1527.member_2.member_12, _e1527.member_2.member_13));
                    bool _e1553 = (_e1421 || _e1528);
                    LightbvhType27_ _e1572 = LightbvhType27_(_e1552.member, _e1552.member_1, LightbvhType26_(_e1552.member_2.member, _e1552.member_2.member_1, _e1552.member_2.member_2, _e1552.member_2.member_3, _e1552.member_2.member_4, _e1552.member_2.member_5, _e1552.member_2.member_6, _e1552.member_2.member_7, _e1552.member_2.member_8, _e1552.member_2.member_9, _e1552.member_2.member_10, _e1552.member_2.member_11, _e1553, _e1552.member_2.member_13));
                    LightbvhType27_ _e1591 = LightbvhType27_(_e1572.member, _e1572.member_1, LightbvhType26_(_e1572.member_2.member, _e1572.member_2.member_1, _e1572.member_2.member_2, _e1572.member_2.member_3, _e1572.member_2.member_4, _e1572.member_2.member_5, _e1572.member_2.member_6, _e1572.member_2.member_7, 20u, _e1572.member_2.member_9, _e1572.member_2.member_10, _e1572.member_2.member_11, _e1572.member_2.member_12, _e1572.member_2.member_13));
                    v63_ = _e1591;
                    if ((_e1364 > 0u)) {
                        uint _e1594 = ((_e1508 < _e141) ? _e1508 : 0u);
                        if ((_e1594 < _e141)) {
                        } else {
                            v72_ = true;
                            break;
                        }
                        uint _e1597 = ((_e1364 - 1u) % 8u);
                        bool _e1598 = (_e1597 < 8u);
                        if (_e1598) {
                        } else {
                            v72_ = true;
                            break;
                        }
                        uint _e1602 = lightbvh_nodes.list[_e1594][1u][_e1597];
                        uint _e1603 = (_e1602 & 3u);
                        if (_e1598) {
                        } else {
                            v72_ = true;
                            break;
                        }
                        uint _e1607 = lightbvh_nodes.list[_e1594][5u][_e1597];
                        LightbvhType27_ _e1626 = LightbvhType27_(_e1591.member, _e1591.member_1, LightbvhType26_(_e1591.member_2.member, _e1591.member_2.member_1, _e1591.member_2.member_2, _e1591.member_2.member_3, _e1591.member_2.member_4, _e1607, _e1591.member_2.member_6, _e1591.member_2.member_7, _e1591.member_2.member_8, _e1591.member_2.member_9, _e1591.member_2.member_10, _e1591.member_2.member_11, _e1591.member_2.member_12, _e1591.member_2.member_13));
                        LightbvhType27_ _e1647 = LightbvhType27_(_e1626.member, _e1626.member_1, LightbvhType26_(_e1626.member_2.member, _e1626.member_2.member_1, _e1626.member_2.member_2, _e1626.member_2.member_3, _e1626.member_2.member_4, _e1626.member_2.member_5, ((_e1603 == 2u) ? _e1607 : 4294967295u), _e1626.member_2.member_7, _e1626.member_2.member_8, _e1626.member_2.member_9, _e1626.member_2.member_10, _e1626.member_2.member_11, _e1626.member_2.member_12, _e1626.member_2.member_13));
                        LightbvhType27_ _e1668 = LightbvhType27_(_e1647.member, _e1647.member_1, LightbvhType26_(_e1647.member_2.member, _e1647.member_2.member_1, _e1647.member_2.member_2, _e1647.member_2.member_3, _e1647.member_2.member_4, _e1647.member_2.member_5, _e1647.member_2.member_6, _e1647.member_2.member_7, _e1647.member_2.member_8, _e1647.member_2.member_9, _e1647.member_2.member_10, _e1647.member_2.member_11, (_e1553 || (_e1603 != 1u)), _e1647.member_2.member_13));
                        v63_ = LightbvhType27_(_e1668.member, _e1668.member_1, LightbvhType26_(_e1668.member_2.member, _e1668.member_2.member_1, _e1668.member_2.member_2, _e1668.member_2.member_3, _e1668.member_2.member_4, _e1668.member_2.member_5, _e1668.member_2.member_6, _e1668.member_2.member_7, 21u, _e1668.member_2.member_9, _e1668.member_2.member_10, _e1668.member_2.member_11, _e1668.member_2.member_12, _e1668.member_2.member_13));
                    }
                    LightbvhType27_ _e1689 = v63_;
                    float _e1699 = lightbvh_instances.list[_e1360].translation[0u];
                    float _e1703 = lightbvh_instances.list[_e1360].translation[1u];
                    float _e1707 = lightbvh_instances.list[_e1360].translation[2u];
                    float _e1708 = (_e176.member.member[0] - _e1699);
                    float _e1709 = (_e176.member.member[1] - _e1703);
                    float _e1710 = (_e176.member.member[2] - _e1707);
                    float _e1715 = ((uintBitsToFloat((floatBitsToUint(_e1708) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1708);
                    float _e1720 = ((uintBitsToFloat((floatBitsToUint(_e1709) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1709);
                    float _e1725 = ((uintBitsToFloat((floatBitsToUint(_e1710) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1710);
                    float _e1730 = lightbvh_instances.list[_e1360].inverse_[0u][0u];
                    float _e1735 = lightbvh_instances.list[_e1360].inverse_[0u][1u];
                    float _e1740 = lightbvh_instances.list[_e1360].inverse_[0u][2u];
                    float _e1748 = lightbvh_instances.list[_e1360].inverse_[1u][0u];
                    float _e1753 = lightbvh_instances.list[_e1360].inverse_[1u][1u];
                    float _e1758 = lightbvh_instances.list[_e1360].inverse_[1u][2u];
                    float _e1769 = lightbvh_instances.list[_e1360].inverse_[2u][0u];
                    float _e1774 = lightbvh_instances.list[_e1360].inverse_[2u][1u];
                    float _e1779 = lightbvh_instances.list[_e1360].inverse_[2u][2u];
                    float _e1783 = (((_e1730 * _e1715) + (_e1748 * _e1720)) + (_e1769 * _e1725));
                    float _e1784 = (((_e1735 * _e1715) + (_e1753 * _e1720)) + (_e1774 * _e1725));
                    float _e1785 = (((_e1740 * _e1715) + (_e1758 * _e1720)) + (_e1779 * _e1725));
                    float _e1796 = lightbvh_instances.list[_e1360].columns[0u][0u];
                    float _e1801 = lightbvh_instances.list[_e1360].columns[0u][1u];
                    float _e1806 = lightbvh_instances.list[_e1360].columns[0u][2u];
                    float _e1811 = (((_e1796 * _e176.member.member_1[0]) + (_e1801 * _e176.member.member_1[1])) + (_e1806 * _e176.member.member_1[2]));
                    float _e1816 = lightbvh_instances.list[_e1360].columns[1u][0u];
                    float _e1821 = lightbvh_instances.list[_e1360].columns[1u][1u];
                    float _e1826 = lightbvh_instances.list[_e1360].columns[1u][2u];
                    float _e1831 = (((_e1816 * _e176.member.member_1[0]) + (_e1821 * _e176.member.member_1[1])) + (_e1826 * _e176.member.member_1[2]));
                    float _e1836 = lightbvh_instances.list[_e1360].columns[2u][0u];
                    float _e1841 = lightbvh_instances.list[_e1360].columns[2u][1u];
                    float _e1846 = lightbvh_instances.list[_e1360].columns[2u][2u];
                    float _e1851 = (((_e1836 * _e176.member.member_1[0]) + (_e1841 * _e176.member.member_1[1])) + (_e1846 * _e176.member.member_1[2]));
                    float _e1856 = ((uintBitsToFloat((floatBitsToUint(_e1811) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1811);
                    float _e1861 = ((uintBitsToFloat((floatBitsToUint(_e1831) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1831);
                    float _e1866 = ((uintBitsToFloat((floatBitsToUint(_e1851) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1851);
                    float _e1871 = (((_e1856 * _e1856) + (_e1861 * _e1861)) + (_e1866 * _e1866));
                    v64_ = 0.0;
                    if ((_e1871 >= uintBitsToFloat(67108864u))) {
                        float _e1878 = uintBitsToFloat((1597463007u - (floatBitsToUint(_e1871) >> uint(1))));
                        float _e1879 = (0.5 * _e1871);
                        float _e1883 = (_e1878 * (1.5 - ((_e1879 * _e1878) * _e1878)));
                        v64_ = (_e1883 * (1.5 - ((_e1879 * _e1883) * _e1883)));
                    }
                    float _e1889 = v64_;
                    float _e1890 = -(1.1529215e18);
                    v65_ = _e1890;
                    if ((_e1783 < _e1890)) {
                    } else {
                        v65_ = ((_e1783 > 1.1529215e18) ? 1.1529215e18 : _e1783);
                    }
                    float _e1895 = v65_;
                    v66_ = _e1890;
                    if ((_e1784 < _e1890)) {
                    } else {
                        v66_ = ((_e1784 > 1.1529215e18) ? 1.1529215e18 : _e1784);
                    }
                    float _e1905 = v66_;
                    v67_ = _e1890;
                    if ((_e1785 < _e1890)) {
                    } else {
                        v67_ = ((_e1785 > 1.1529215e18) ? 1.1529215e18 : _e1785);
                    }
                    float _e1915 = v67_;
                    float _e1922 = (_e1856 * _e1889);
                    float _e1928 = (_e1861 * _e1889);
                    float _e1934 = (_e1866 * _e1889);
                    v60_ = LightbvhType27_(_e1689.member, _e1689.member_1, LightbvhType26_(_e1689.member_2.member, _e1689.member_2.member_1, LightbvhType14_(float[3](((uintBitsToFloat((floatBitsToUint(_e1895) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1895), ((uintBitsToFloat((floatBitsToUint(_e1905) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1905), ((uintBitsToFloat((floatBitsToUint(_e1915) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1915)), float[3](((uintBitsToFloat((floatBitsToUint(_e1922) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1922), ((uintBitsToFloat((floatBitsToUint(_e1928) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1928), ((uintBitsToFloat((floatBitsToUint(_e1934) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1934))), _e1689.member_2.member_3, _e1689.member_2.member_4, _e1689.member_2.member_5, _e1689.member_2.member_6, _e1689.member_2.member_7, _e1689.member_2.member_8, _e1689.member_2.member_9, _e1689.member_2.member_10, _e1689.member_2.member_11, _e1689.member_2.member_12, _e1689.member_2.member_13));
                }
                LightbvhType27_ _e1442 = v60_;
                v68_ = _e1442;
                if (_e1369) {
                } else {
                    v61_ = _e571.member_2.member_5;
                    if (_e1373) {
                        v61_ = (_e1258 + (_e938 ? _e150 : 0u));
                    }
                    uint _e1446 = v61_;
                    LightbvhType27_ _e1465 = LightbvhType27_(_e1440.member, _e1440.member_1, LightbvhType26_(_e1440.member_2.member, _e1440.member_2.member_1, _e1440.member_2.member_2, _e1440.member_2.member_3, _e1440.member_2.member_4, _e1446, _e1440.member_2.member_6, _e1440.member_2.member_7, _e1440.member_2.member_8, _e1440.member_2.member_9, _e1440.member_2.member_10, _e1440.member_2.member_11, _e1440.member_2.member_12, _e1440.member_2.member_13));
                    v68_ = LightbvhType27_(_e1465.member, _e1465.member_1, LightbvhType26_(_e1465.member_2.member, _e1465.member_2.member_1, _e1465.member_2.member_2, _e1465.member_2.member_3, _e1465.member_2.member_4, _e1465.member_2.member_5, _e1465.member_2.member_6, _e1465.member_2.member_7, (_e571.member_2.member_8 + (_e1373 ? 1u : 0u)), _e1465.member_2.member_9, _e1465.member_2.member_10, _e1465.member_2.member_11, _e1465.member_2.member_12, _e1465.member_2.member_13));
                }
                LightbvhType27_ _e1962 = v68_;
                v69_ = _e915;
                v70_ = _e1962;
                v71_ = _e1962.member_2.member_12;
            }
            bool _e1966 = v69_;
            LightbvhType27_ _e1968 = v70_;
            bool _e1970 = v71_;
            continue;
        }
        bool _e1974 = v72_;
        if (_e1974) {
            break;
        }
        LightbvhType27_ _e1976 = v73_;
        bool _e1978 = (_e1976.member != 4294967295u);
        LightbvhType27_ _e1980 = v74_;
        LightbvhType27_ _e1986 = v75_;
        LightbvhType27_ _e1990 = v76_;
        bool _e1994 = ((_e1980.member_2.member_6 != 4294967295u) && (!(_e1978) || (_e1986.member_2.member_7 == _e1990.member_1)));
        uint _e1995 = (_e1978 ? _e1990.member_1 : _e1986.member_2.member_7);
        v78_ = _e1976.member;
        if (_e1978) {
        } else {
            bool _e1996 = (_e1986.member_2.member_7 < _e144);
            v77_ = _e1980.member_2.member_6;
            if (_e1996) {
                if (_e1996) {
                } else {
                    break;
                }
                uint _e1999 = lightbvh_instances.list[_e1986.member_2.member_7].first_light;
                uint _e2003 = lightbvh_instances.list[_e1986.member_2.member_7].first;
                v77_ = ((_e1980.member_2.member_6 - _e1999) + _e2003);
            }
            uint _e2006 = v77_;
            v78_ = _e2006;
        }
        uint _e2008 = v78_;
        v81_ = 0.0;
        if (_e1994) {
            LightbvhType27_ _e2010 = v79_;
            LightbvhType27_ _e2016 = v80_;
            int _e2023 = -(int((22u + ((_e2010.member_2.member_10 < 98u) ? _e2010.member_2.member_10 : 98u))));
            int _e2025 = ((_e2023 < -126) ? -126 : _e2023);
            v81_ = (float(int(_e2016.member_2.member_9)) * uintBitsToFloat((uint((((_e2025 > 127) ? 127 : _e2025) + 127)) << uint(23))));
        }
        float _e2035 = v81_;
        v83_ = 0u;
        v84_ = true;
        if ((_e168 > 0u)) {
            bool _e2037 = (_e1995 < _e144);
            v82_ = 0u;
            if (_e2037) {
                if (_e2037) {
                } else {
                    break;
                }
                uint _e2040 = lightbvh_instances.list[_e1995].count;
                v82_ = _e2040;
            }
            uint _e2042 = v82_;
            v83_ = _e2042;
            v84_ = (_e2037 ? false : true);
        }
        uint _e2045 = v83_;
        bool _e2047 = v84_;
        uint _e2052 = ((_e2047 ? _e171 : _e2045) & 2147483647u);
        uint _e2057 = floatBitsToUint((float(65536) * uintBitsToFloat(880803840u)));
        uint _e2058 = floatBitsToUint(float(int(((_e2052 > 0u) ? _e2052 : 1u))));
        uint _e2063 = ((_e2057 >> uint(23)) & 255u);
        uint _e2067 = (_e2057 & 8388607u);
        uint _e2068 = (_e2067 | 8388608u);
        uint _e2069 = (_e2058 & 8388607u);
        uint _e2070 = (_e2069 | 8388608u);
        bool _e2071 = (_e2068 < _e2070);
        float _e2075 = uintBitsToFloat((_e2069 | 1065353216u));
        uint _e2076 = floatBitsToUint(_e2075);
        float _e2081 = uintBitsToFloat(((_e2076 & 2147483648u) | (2129859015u - (_e2076 & 2147483647u))));
        float _e2084 = (_e2081 * (2.0 - (_e2075 * _e2081)));
        float _e2087 = (_e2084 * (2.0 - (_e2075 * _e2084)));
        float _e2091 = ((uintBitsToFloat((_e2067 | 1065353216u)) * _e2087) * (_e2071 ? 16777216.0 : 8388608.0));
        float _e2092 = uintBitsToFloat(0u);
        float _e2093 = uintBitsToFloat(1333788671u);
        uint _e2098 = ((_e2091 > _e2093) ? 4294967295u : ((_e2091 < _e2092) ? 0u : uint(_e2091)));
        int _e2104 = int(((_e2068 << uint(((_e2071 ? 24 : 23) & 31))) - (_e2098 * _e2070)));
        float _e2109 = ((float((_e2104 >> uint(8))) * _e2087) * 3.0517578e-5);
        float _e2110 = uintBitsToFloat(3472883712u);
        float _e2111 = uintBitsToFloat(1325400063u);
        int _e2118 = ((_e2109 == _e2109) ? ((_e2109 > _e2111) ? 2147483647 : ((_e2109 < _e2110) ? -2147483648 : int(_e2109))) : 0);
        uint _e2120 = (_e2098 + uint(_e2118));
        int _e2121 = int(_e2070);
        int _e2123 = (_e2104 - (_e2118 * _e2121));
        bool _e2124 = (_e2123 < 0);
        v85_ = _e2120;
        if (_e2124) {
            v85_ = (_e2120 - 1u);
        }
        uint _e2127 = v85_;
        v86_ = _e2123;
        if (_e2124) {
            v86_ = (_e2123 + _e2121);
        }
        int _e2130 = v86_;
        bool _e2131 = (_e2130 >= _e2121);
        v87_ = _e2127;
        if (_e2131) {
            v87_ = (_e2127 + 1u);
        }
        uint _e2134 = v87_;
        v88_ = _e2130;
        if (_e2131) {
            v88_ = (_e2130 - _e2121);
        }
        int _e2137 = v88_;
        v89_ = _e2134;
        if (((_e2137 * 2) > _e2121)) {
            v89_ = (_e2134 + 1u);
        }
        uint _e2142 = v89_;
        int _e2147 = ((int(_e2063) - int(((_e2058 >> uint(23)) & 255u))) + (_e2071 ? 126 : 127));
        v92_ = 0u;
        v93_ = true;
        if ((_e2063 == 0u)) {
        } else {
            bool _e2149 = (_e2147 <= 0);
            v91_ = 0u;
            if (_e2149) {
            } else {
                v90_ = 2139095040u;
                if ((_e2147 >= 255)) {
                } else {
                    v90_ = ((uint(_e2147) << uint(23)) + (_e2142 & 8388607u));
                }
                uint _e2157 = v90_;
                v91_ = _e2157;
            }
            uint _e2159 = v91_;
            v92_ = _e2159;
            v93_ = _e2149;
        }
        uint _e2161 = v92_;
        bool _e2163 = v93_;
        uint _e2167 = (_e168 & 2147483647u);
        uint _e2172 = floatBitsToUint(uintBitsToFloat((((_e2057 ^ _e2058) & 2147483648u) | (_e2163 ? 0u : _e2161))));
        uint _e2173 = floatBitsToUint(float(int(((_e2167 > 0u) ? _e2167 : 1u))));
        uint _e2178 = ((_e2172 >> uint(23)) & 255u);
        uint _e2182 = (_e2172 & 8388607u);
        uint _e2183 = (_e2182 | 8388608u);
        uint _e2184 = (_e2173 & 8388607u);
        uint _e2185 = (_e2184 | 8388608u);
        bool _e2186 = (_e2183 < _e2185);
        float _e2190 = uintBitsToFloat((_e2184 | 1065353216u));
        uint _e2191 = floatBitsToUint(_e2190);
        float _e2196 = uintBitsToFloat(((_e2191 & 2147483648u) | (2129859015u - (_e2191 & 2147483647u))));
        float _e2199 = (_e2196 * (2.0 - (_e2190 * _e2196)));
        float _e2202 = (_e2199 * (2.0 - (_e2190 * _e2199)));
        float _e2206 = ((uintBitsToFloat((_e2182 | 1065353216u)) * _e2202) * (_e2186 ? 16777216.0 : 8388608.0));
        uint _e2211 = ((_e2206 > _e2093) ? 4294967295u : ((_e2206 < _e2092) ? 0u : uint(_e2206)));
        int _e2217 = int(((_e2183 << uint(((_e2186 ? 24 : 23) & 31))) - (_e2211 * _e2185)));
        float _e2222 = ((float((_e2217 >> uint(8))) * _e2202) * 3.0517578e-5);
        int _e2229 = ((_e2222 == _e2222) ? ((_e2222 > _e2111) ? 2147483647 : ((_e2222 < _e2110) ? -2147483648 : int(_e2222))) : 0);
        uint _e2231 = (_e2211 + uint(_e2229));
        int _e2232 = int(_e2185);
        int _e2234 = (_e2217 - (_e2229 * _e2232));
        bool _e2235 = (_e2234 < 0);
        v94_ = _e2231;
        if (_e2235) {
            v94_ = (_e2231 - 1u);
        }
        uint _e2238 = v94_;
        v95_ = _e2234;
        if (_e2235) {
            v95_ = (_e2234 + _e2232);
        }
        int _e2241 = v95_;
        bool _e2242 = (_e2241 >= _e2232);
        v96_ = _e2238;
        if (_e2242) {
            v96_ = (_e2238 + 1u);
        }
        uint _e2245 = v96_;
        v97_ = _e2241;
        if (_e2242) {
            v97_ = (_e2241 - _e2232);
        }
        int _e2248 = v97_;
        v98_ = _e2245;
        if (((_e2248 * 2) > _e2232)) {
            v98_ = (_e2245 + 1u);
        }
        uint _e2253 = v98_;
        int _e2258 = ((int(_e2178) - int(((_e2173 >> uint(23)) & 255u))) + (_e2186 ? 126 : 127));
        v101_ = 0u;
        v102_ = true;
        if ((_e2178 == 0u)) {
        } else {
            bool _e2260 = (_e2258 <= 0);
            v100_ = 0u;
            if (_e2260) {
            } else {
                v99_ = 2139095040u;
                if ((_e2258 >= 255)) {
                } else {
                    v99_ = ((uint(_e2258) << uint(23)) + (_e2253 & 8388607u));
                }
                uint _e2268 = v99_;
                v100_ = _e2268;
            }
            uint _e2270 = v100_;
            v101_ = _e2270;
            v102_ = _e2260;
        }
        uint _e2272 = v101_;
        bool _e2274 = v102_;
        v103_ = LightbvhType19_(4294967295u, 4294967295u, 0.0);
        if ((_e1978 || _e1994)) {
            v103_ = LightbvhType19_(_e2008, _e1995, (_e2035 + uintBitsToFloat((((_e2172 ^ _e2173) & 2147483648u) | (_e2274 ? 0u : _e2272)))));
        }
        LightbvhType19_ _e2282 = v103_;
        results = _e2282;
        break;
    } while(false);
    LightbvhType19_ _e2388 = results;
    return LightbvhLightSample(_e2388.member, _e2388.member_1, _e2388.member_2);
}

float lightbvh_pmf(vec3 p_1, vec3 n_1, uint light, uint instance) {
    LightbvhType16_ queries_1 = LightbvhType16_(LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), uint[2](0u, 0u));
    float results_1 = 0.0;
    float v0_1[8] = float[8](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    uint v1_1 = 0u;
    uint v2_1 = 0u;
    bool v3_1 = false;
    uint v4_1 = 0u;
    uint v5_1 = 0u;
    uint v6_1 = 0u;
    bool v7_1 = false;
    bool v8_1 = false;
    LightbvhType24_ v9_1 = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
    uint v10_1 = 0u;
    uint v11_1 = 0u;
    uint v12_1 = 0u;
    uint v13_1 = 0u;
    bool v14_1 = false;
    uint v15_1 = 0u;
    LightbvhType23_ v16_1 = LightbvhType23_(0u, 0u);
    uint v17_1 = 0u;
    uint v18_1 = 0u;
    uint v19_1 = 0u;
    LightbvhType23_ v20_1 = LightbvhType23_(0u, 0u);
    uint v21_1 = 0u;
    uint v22_1 = 0u;
    LightbvhType23_ v23_1 = LightbvhType23_(0u, 0u);
    uint v24_1 = 0u;
    bool v25_1 = false;
    bool v26_1 = false;
    LightbvhType23_ v27_1 = LightbvhType23_(0u, 0u);
    bool v28_1 = false;
    LightbvhType24_ v29_1 = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
    bool v30_1 = false;
    LightbvhType26_ v31_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
    bool v32_1 = false;
    LightbvhType23_ v33_1 = LightbvhType23_(0u, 0u);
    LightbvhType23_ v34_1 = LightbvhType23_(0u, 0u);
    LightbvhType23_ v35_1 = LightbvhType23_(0u, 0u);
    LightbvhType23_ v36_1 = LightbvhType23_(0u, 0u);
    LightbvhType23_ v37_1 = LightbvhType23_(0u, 0u);
    bool v38_1 = false;
    uint v39_1 = 0u;
    uint v40_1 = 0u;
    uint v41_1 = 0u;
    uint v42_1 = 0u;
    int v43_1 = 0;
    uint v44_1 = 0u;
    bool v45_1 = false;
    LightbvhType26_ v46_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
    uint v47_1 = 0u;
    uint v48_1 = 0u;
    LightbvhType26_ v49_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
    float v50_1 = 0.0;
    float v51_1 = 0.0;
    float v52_1 = 0.0;
    float v53_1 = 0.0;
    LightbvhType26_ v54_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
    bool v55_1 = false;
    LightbvhType26_ v56_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
    bool v57_1 = false;
    bool v58_1 = false;
    LightbvhType26_ v59_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
    LightbvhType26_ v60_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
    LightbvhType26_ v61_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
    LightbvhType26_ v62_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
    float v63_1 = 0.0;
    uint v64_1 = 0u;
    uint v65_1 = 0u;
    bool v66_1 = false;
    uint v67_1 = 0u;
    int v68_1 = 0;
    uint v69_1 = 0u;
    int v70_1 = 0;
    uint v71_1 = 0u;
    uint v72_1 = 0u;
    uint v73_1 = 0u;
    uint v74_1 = 0u;
    bool v75_1 = false;
    uint v76_1 = 0u;
    int v77_1 = 0;
    uint v78_1 = 0u;
    int v79_1 = 0;
    uint v80_1 = 0u;
    uint v81_1 = 0u;
    uint v82_1 = 0u;
    uint v83_1 = 0u;
    bool v84_1 = false;
    bool v85_1 = false;
    bool v86_1 = false;
    bool v87_1 = false;
    float v88_1 = 0.0;
    queries_1 = LightbvhType16_(LightbvhType14_(float[3](p_1.x, p_1.y, p_1.z), float[3](n_1.x, n_1.y, n_1.z)), uint[2](light, instance));
    do {
        uint _e135 = uint(lightbvh_nodes.list.length());
        uint _e138 = uint(lightbvh_instances.list.length());
        uint _e141 = uint(lightbvh_trails.list.length());
        uint _e144 = lightbvh_tree.top;
        uint _e147 = lightbvh_tree.root;
        uint _e150 = lightbvh_tree.above;
        uint _e153 = lightbvh_tree.places;
        uint _e156 = lightbvh_tree.parts;
        uint _e159 = lightbvh_tree.trail_words;
        uint _e162 = lightbvh_tree.live;
        uint _e165 = lightbvh_tree.lights;
        uint _e168 = lightbvh_tree.depth;
        LightbvhType16_ _e170 = queries_1;
        bool _e176 = (_e162 > 0u);
        uint _e177 = (_e176 ? _e170.member_1[1] : 4294967295u);
        bool _e178 = (_e177 < _e138);
        v2_1 = 0u;
        v3_1 = true;
        if (_e178) {
            v1_1 = 0u;
            if (_e176) {
                if (_e178) {
                } else {
                    break;
                }
                uint _e181 = lightbvh_instances.list[_e177].first;
                uint _e185 = lightbvh_instances.list[_e177].first_light;
                v1_1 = ((_e170.member_1[0] - _e181) + _e185);
            }
            uint _e188 = v1_1;
            v2_1 = _e188;
            v3_1 = (_e176 ? false : true);
        }
        uint _e191 = v2_1;
        bool _e193 = v3_1;
        uint _e194 = (_e193 ? _e170.member_1[0] : _e191);
        uint _e195 = (_e194 * _e159);
        bool _e196 = (_e195 < _e141);
        v4_1 = 0u;
        if (_e196) {
            if (_e196) {
            } else {
                break;
            }
            uint _e198 = lightbvh_trails.list[_e195];
            v4_1 = _e198;
        }
        uint _e200 = v4_1;
        v6_1 = 0u;
        v7_1 = true;
        if ((_e159 == 2u)) {
            uint _e202 = (_e195 + 1u);
            bool _e203 = (_e202 < _e141);
            v5_1 = 0u;
            if (_e203) {
                if (_e203) {
                } else {
                    break;
                }
                uint _e205 = lightbvh_trails.list[_e202];
                v5_1 = _e205;
            }
            uint _e207 = v5_1;
            v6_1 = _e207;
            v7_1 = (_e203 ? false : true);
        }
        uint _e210 = v6_1;
        bool _e212 = v7_1;
        uint _e213 = (_e212 ? 0u : _e210);
        v8_1 = false;
        v9_1 = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
        if (_e178) {
            uint _e220 = (_e153 + _e177);
            bool _e221 = (_e220 < _e141);
            v10_1 = 4294967295u;
            if (_e221) {
                if (_e221) {
                } else {
                    break;
                }
                uint _e223 = lightbvh_trails.list[_e220];
                v10_1 = _e223;
            }
            uint _e225 = v10_1;
            v13_1 = 0u;
            v14_1 = true;
            if ((_e225 != 4294967295u)) {
                bool _e227 = (_e225 >= 2147483648u);
                v12_1 = 0u;
                if (_e227) {
                    uint _e231 = (_e156 + ((_e225 - 2147483648u) + (_e200 & 7u)));
                    bool _e232 = (_e231 < _e141);
                    v11_1 = 4294967295u;
                    if (_e232) {
                        if (_e232) {
                        } else {
                            break;
                        }
                        uint _e234 = lightbvh_trails.list[_e231];
                        v11_1 = _e234;
                    }
                    uint _e236 = v11_1;
                    v12_1 = _e236;
                }
                uint _e238 = v12_1;
                v13_1 = _e238;
                v14_1 = (_e227 ? false : true);
            }
            uint _e241 = v13_1;
            bool _e243 = v14_1;
            v15_1 = 0u;
            v16_1 = LightbvhType23_(0u, 0u);
            v17_1 = (_e243 ? _e225 : _e241);
            bool loop_init_3 = true;
            while(true) {
                if (!loop_init_3) {
                    v15_1 = v22_1;
                    v16_1 = v23_1;
                    v17_1 = v24_1;
                    v26_1 = false;
                    if (!(v25_1)) {
                        break;
                    }
                }
                loop_init_3 = false;
                uint _e246 = v15_1;
                LightbvhType23_ _e248 = v16_1;
                uint _e250 = v17_1;
                v27_1 = _e248;
                v22_1 = 0u;
                v23_1 = LightbvhType23_(0u, 0u);
                v24_1 = 0u;
                v25_1 = false;
                if ((_e250 < 2147483648u)) {
                    bool _e252 = (_e246 < 20u);
                    v19_1 = 0u;
                    v20_1 = LightbvhType23_(0u, 0u);
                    v21_1 = 0u;
                    if (_e252) {
                        uint _e271 = (_e150 + (_e250 >> 3u));
                        bool _e272 = (_e271 < _e141);
                        v18_1 = 4294967295u;
                        if (_e272) {
                            if (_e272) {
                            } else {
                                v26_1 = true;
                                break;
                            }
                            uint _e274 = lightbvh_trails.list[_e271];
                            v18_1 = _e274;
                        }
                        uint _e276 = v18_1;
                        v19_1 = (_e246 + 1u);
                        v20_1 = LightbvhType23_((((_e248.member << 3u) | ((_e250 & 7u) & 7u)) & 1073741823u), (((_e248.member_1 << 3u) | ((_e248.member >> 27u) & 7u)) & 1073741823u));
                        v21_1 = _e276;
                    }
                    uint _e279 = v19_1;
                    LightbvhType23_ _e281 = v20_1;
                    uint _e283 = v21_1;
                    v22_1 = _e279;
                    v23_1 = _e281;
                    v24_1 = _e283;
                    v25_1 = _e252;
                }
                uint _e285 = v22_1;
                LightbvhType23_ _e287 = v23_1;
                uint _e289 = v24_1;
                bool _e291 = v25_1;
                continue;
            }
            bool _e294 = v26_1;
            if (_e294) {
                break;
            }
            LightbvhType23_ _e297 = v27_1;
            v8_1 = _e294;
            v9_1 = LightbvhType24_(_e297, LightbvhType23_(_e200, _e213));
        }
        bool _e215 = v8_1;
        LightbvhType24_ _e217 = v9_1;
        v28_1 = _e215;
        v29_1 = _e217;
        if (_e178) {
        } else {
            v28_1 = false;
            v29_1 = LightbvhType24_(LightbvhType23_(_e200, _e213), LightbvhType23_(0u, 0u));
        }
        bool _e300 = v28_1;
        LightbvhType24_ _e302 = v29_1;
        bool _e304 = (_e168 == 0u);
        LightbvhType26_ _e305 = LightbvhType26_(_e302, LightbvhType23_(0u, 0u), _e170.member, LightbvhType25_(0.0, 1.0), 0u, (_e147 + _e144), 4294967295u, 4294967295u, 0u, 4194304u, 0u, _e168, _e304, true);
        uint _e308 = (uint(21) - uint(findMSB(4128767u)));
        uint _e310 = ((_e308 < 22u) ? _e308 : 22u);
        uint _e311 = (_e310 & 31u);
        LightbvhType26_ _e329 = LightbvhType26_(_e305.member, LightbvhType23_((4227858432u << _e311), 0u), _e305.member_2, _e305.member_3, _e305.member_4, _e305.member_5, _e305.member_6, _e305.member_7, _e305.member_8, _e305.member_9, _e305.member_10, _e305.member_11, _e305.member_12, _e305.member_13);
        LightbvhType26_ _e346 = LightbvhType26_(_e329.member, _e329.member_1, _e329.member_2, _e329.member_3, _e329.member_4, _e329.member_5, _e329.member_6, _e329.member_7, _e329.member_8, (4128768u << _e311), _e329.member_10, _e329.member_11, _e329.member_12, _e329.member_13);
        v30_1 = _e300;
        v31_1 = LightbvhType26_(_e346.member, _e346.member_1, _e346.member_2, _e346.member_3, _e346.member_4, _e346.member_5, _e346.member_6, _e346.member_7, _e346.member_8, _e346.member_9, _e310, _e346.member_11, _e346.member_12, _e346.member_13);
        v32_1 = _e304;
        bool loop_init_4 = true;
        while(true) {
            if (!loop_init_4) {
                v30_1 = v55_1;
                v31_1 = v56_1;
                v32_1 = v57_1;
                v58_1 = v55_1;
                if (!((v32_1 ? false : true))) {
                    break;
                }
            }
            loop_init_4 = false;
            bool _e363 = v30_1;
            LightbvhType26_ _e365 = v31_1;
            bool _e367 = v32_1;
            v59_1 = _e365;
            v60_1 = _e365;
            v61_1 = _e365;
            v62_1 = _e365;
            v55_1 = _e363;
            v56_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
            v57_1 = false;
            if (_e367) {
            } else {
                bool _e369 = (_e365.member_5 < _e135);
                uint _e370 = (_e369 ? _e365.member_5 : 0u);
                if ((_e370 < _e135)) {
                } else {
                    v58_1 = true;
                    break;
                }
                uint _e393 = lightbvh_nodes.list[_e370][0u][3u];
                int _e396 = (int((_e393 & 255u)) - 127);
                uint _e407 = lightbvh_nodes.list[_e370][0u][0u];
                uint _e412 = lightbvh_nodes.list[_e370][0u][1u];
                uint _e417 = lightbvh_nodes.list[_e370][0u][2u];
                float _e419 = (uintBitsToFloat(_e407) - _e365.member_2.member[0]);
                float _e420 = (uintBitsToFloat(_e412) - _e365.member_2.member[1]);
                float _e421 = (uintBitsToFloat(_e417) - _e365.member_2.member[2]);
                float _e424 = uintBitsToFloat((floatBitsToUint(_e419) & 2147483647u));
                float _e427 = uintBitsToFloat((floatBitsToUint(_e420) & 2147483647u));
                float _e430 = uintBitsToFloat((floatBitsToUint(_e421) & 2147483647u));
                float _e432 = ((_e424 > _e427) ? _e424 : _e427);
                int _e440 = (int(((floatBitsToUint(((_e432 > _e430) ? _e432 : _e430)) >> uint(23)) & 255u)) - 127);
                int _e442 = ((_e440 > _e396) ? _e440 : _e396);
                int _e443 = (_e396 - _e442);
                int _e445 = ((_e443 < -40) ? -40 : _e443);
                int _e446 = -(_e442);
                int _e448 = ((_e446 < -126) ? -126 : _e446);
                float _e455 = uintBitsToFloat((uint((((_e448 > 127) ? 127 : _e448) + 127)) << uint(23)));
                int _e460 = ((_e445 < -126) ? -126 : _e445);
                float _e467 = uintBitsToFloat((uint((((_e460 > 127) ? 127 : _e460) + 127)) << uint(23)));
                float _e468 = (_e467 * 4.656613e-10);
                float _e480 = (2.0 * 8.0);
                float _e481 = (uintBitsToFloat((floatBitsToUint(_e365.member_2.member_1[0]) & 2147483647u)) * _e480);
                float _e482 = (uintBitsToFloat((floatBitsToUint(_e365.member_2.member_1[1]) & 2147483647u)) * _e480);
                float _e483 = (uintBitsToFloat((floatBitsToUint(_e365.member_2.member_1[2]) & 2147483647u)) * _e480);
                v0_1 = float[8](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
                v33_1 = LightbvhType23_(0u, 8u);
                bool loop_init_5 = true;
                while(true) {
                    if (!loop_init_5) {
                        v33_1 = v36_1;
                        v38_1 = _e363;
                        if (!((int(v37_1.member) != 0))) {
                            break;
                        }
                    }
                    loop_init_5 = false;
                    LightbvhType23_ _e490 = v33_1;
                    bool _e493 = (_e490.member < _e490.member_1);
                    v34_1 = LightbvhType23_(0u, 0u);
                    v35_1 = LightbvhType23_(0u, 0u);
                    if (_e493) {
                        v34_1 = LightbvhType23_((_e490.member + 1u), _e490.member_1);
                        v35_1 = LightbvhType23_(1u, _e490.member);
                    }
                    LightbvhType23_ _e495 = v34_1;
                    LightbvhType23_ _e497 = v35_1;
                    v36_1 = _e495;
                    v37_1 = _e497;
                    if (_e493) {
                    } else {
                        v36_1 = _e490;
                        v37_1 = LightbvhType23_(0u, LightbvhType23_(0u, 0u).member_1);
                    }
                    LightbvhType23_ _e507 = v36_1;
                    LightbvhType23_ _e509 = v37_1;
                    bool _e513 = (int(_e509.member) != 0);
                    if (_e513) {
                        bool _e514 = (_e509.member_1 < 8u);
                        if (_e514) {
                        } else {
                            v38_1 = true;
                            break;
                        }
                        uint _e518 = lightbvh_nodes.list[_e370][1u][_e509.member_1];
                        if (_e514) {
                        } else {
                            v38_1 = true;
                            break;
                        }
                        uint _e522 = lightbvh_nodes.list[_e370][2u][_e509.member_1];
                        if (_e514) {
                        } else {
                            v38_1 = true;
                            break;
                        }
                        uint _e526 = lightbvh_nodes.list[_e370][3u][_e509.member_1];
                        if (_e514) {
                        } else {
                            v38_1 = true;
                            break;
                        }
                        uint _e530 = lightbvh_nodes.list[_e370][4u][_e509.member_1];
                        float _e546 = ((_e419 * _e455) + (float(int(_e518)) * _e468));
                        float _e547 = ((_e420 * _e455) + (float(int((_e518 << 15u))) * _e468));
                        float _e548 = ((_e421 * _e455) + (float(int(_e522)) * _e468));
                        float _e553 = uintBitsToFloat((((_e530 << 20u) & 267386880u) + (floatBitsToUint(_e467) + 4043309056u)));
                        float _e558 = (float(int((_e522 << 15u))) * 4.656613e-10);
                        float _e560 = float(int(_e526));
                        float _e564 = float(int((_e526 << 8u)));
                        float _e568 = float(int((_e526 << 16u)));
                        float _e572 = (float(int((_e526 & 255u))) * 0.003921569);
                        float _e589 = (_e553 * _e553);
                        float _e595 = ((((_e546 * _e546) + (_e547 * _e547)) + (_e548 * _e548)) + 8.881784e-16);
                        float _e599 = (_e595 + (1.25 * _e589));
                        float _e604 = uintBitsToFloat((1595932665u - (floatBitsToUint(_e599) >> uint(1))));
                        float _e609 = (_e604 * (0.70395225 * (2.3892446 - (_e599 * (_e604 * _e604)))));
                        float _e610 = (_e553 * _e609);
                        float _e615 = ((((_e365.member_2.member_1[0] * 4.656613e-10) * _e560) + ((_e365.member_2.member_1[1] * 4.656613e-10) * _e564)) + ((_e365.member_2.member_1[2] * 4.656613e-10) * _e568));
                        float _e620 = (0.03162278 + (_e610 * (1.0 + (_e558 * (_e615 * _e615)))));
                        float _e626 = (((((_e365.member_2.member_1[0] + _e365.member_2.member_1[0]) * _e546) + ((_e365.member_2.member_1[1] + _e365.member_2.member_1[1]) * _e547)) + ((_e365.member_2.member_1[2] + _e365.member_2.member_1[2]) * _e548)) * _e609);
                        float _e628 = (_e626 + ((((_e481 + _e482) + _e483) + ((((_e481 * 4.656613e-10) * float(int(_e530))) + ((_e482 * 4.656613e-10) * float(int((_e530 << 8u))))) + ((_e483 * 4.656613e-10) * float(int((_e530 << 16u)))))) * _e610));
                        float _e630 = ((_e628 > 0.0001) ? _e628 : 0.0001);
                        float _e636 = (uintBitsToFloat((floatBitsToUint(_e626) & 2147483647u)) + _e620);
                        float _e642 = (1.0 + _e558);
                        float _e648 = ((((_e560 * _e546) + (_e564 * _e547)) + (_e568 * _e548)) * (-2.0 * 4.656613e-10));
                        float _e651 = (_e553 * ((_e642 > _e572) ? _e642 : _e572));
                        float _e653 = (_e595 - (2.5 * _e589));
                        float _e655 = (0.25 * (_e648 * _e648));
                        float _e661 = ((((_e653 > _e655) ? _e653 : _e655) + 8.881784e-16) + (1.25 * (_e651 * _e651)));
                        float _e666 = uintBitsToFloat((1595932665u - (floatBitsToUint(_e661) >> uint(1))));
                        float _e671 = (_e666 * (0.70395225 * (2.3892446 - (_e661 * (_e666 * _e666)))));
                        float _e673 = ((_e553 * _e671) * _e642);
                        float _e677 = ((0.03162278 + _e673) + (_e572 * (0.5 - _e673)));
                        float _e678 = (_e648 * _e671);
                        float _e682 = (uintBitsToFloat((floatBitsToUint(_e678) & 2147483647u)) + _e677);
                        float _e691 = ((_e636 * _e682) * (_e595 + (0.5 * _e589)));
                        float _e694 = uintBitsToFloat((2129859015u - floatBitsToUint(_e691)));
                        if (_e514) {
                        } else {
                            v38_1 = true;
                            break;
                        }
                        v0_1[_e509.member_1] = ((uintBitsToFloat(((_e522 & 2047u) << 19u)) * (((((_e626 > 0.0) ? _e626 : 0.0) * _e636) + (_e620 * ((_e630 < _e620) ? _e630 : _e620))) * ((((_e678 > 0.0) ? _e678 : 0.0) * _e682) + (_e677 * _e677)))) * (_e694 * (2.0 - (_e691 * _e694))));
                    }
                    continue;
                }
                bool _e702 = v38_1;
                v58_1 = _e702;
                if (_e702) {
                    break;
                }
                float _e703[8] = v0_1;
                bool _e720 = (_e365.member_8 < 20u);
                v39_1 = 0u;
                if (_e720) {
                    bool _e743 = (_e365.member_8 < 10u);
                    v41_1 = _e365.member_8;
                    if (_e743) {
                    } else {
                        v41_1 = (_e365.member_8 - 10u);
                    }
                    uint _e746 = v41_1;
                    v39_1 = (((_e743 ? _e365.member.member.member : _e365.member.member.member_1) >> (((_e746 * 3u) & 31u) & 31u)) & 7u);
                }
                uint _e722 = v39_1;
                v42_1 = _e722;
                if (_e720) {
                } else {
                    uint _e727 = (_e365.member_8 - 20u);
                    bool _e728 = (_e727 < 10u);
                    v40_1 = _e727;
                    if (_e728) {
                    } else {
                        v40_1 = (_e365.member_8 - 30u);
                    }
                    uint _e731 = v40_1;
                    v42_1 = (((_e728 ? _e365.member.member_1.member : _e365.member.member_1.member_1) >> (((_e731 * 3u) & 31u) & 31u)) & 7u);
                }
                uint _e755 = v42_1;
                uint _e760 = (0u - ((_e703[1] > 0.0) ? 1u : 0u));
                uint _e761 = (1u & _e760);
                uint _e765 = (0u - ((_e703[2] > 0.0) ? 1u : 0u));
                uint _e768 = (_e761 ^ ((2u ^ _e761) & _e765));
                uint _e772 = (0u - ((_e703[3] > 0.0) ? 1u : 0u));
                uint _e775 = (_e768 ^ ((3u ^ _e768) & _e772));
                uint _e779 = (0u - ((_e703[4] > 0.0) ? 1u : 0u));
                uint _e782 = (_e775 ^ ((4u ^ _e775) & _e779));
                uint _e786 = (0u - ((_e703[5] > 0.0) ? 1u : 0u));
                uint _e789 = (_e782 ^ ((5u ^ _e782) & _e786));
                uint _e793 = (0u - ((_e703[6] > 0.0) ? 1u : 0u));
                uint _e796 = (_e789 ^ ((6u ^ _e789) & _e793));
                uint _e800 = (0u - ((_e703[7] > 0.0) ? 1u : 0u));
                uint _e803 = (_e796 ^ ((7u ^ _e796) & _e800));
                float _e806 = ((((0.0 + _e703[0]) + _e703[4]) + ((0.0 + _e703[2]) + _e703[6])) + (((0.0 + _e703[1]) + _e703[5]) + ((0.0 + _e703[3]) + _e703[7])));
                bool _e807 = (_e806 > 0.0);
                float _e811 = (_e807 ? _e806 : 1.0);
                uint _e812 = floatBitsToUint(_e811);
                float _e817 = uintBitsToFloat(((_e812 & 2147483648u) | (2129859015u - (_e812 & 2147483647u))));
                float _e820 = (_e817 * (2.0 - (_e811 * _e817)));
                float _e824 = ((float(int(_e365.member_9)) * 0.9999695) * (_e820 * (2.0 - (_e811 * _e820))));
                v43_1 = 2147483647;
                if (_e365.member_13) {
                } else {
                    v43_1 = int((_e365.member_1.member >> 10u));
                }
                int _e827 = v43_1;
                int _e833 = int((floatBitsToUint(((_e703[0] * _e824) + 8388608.0)) & 8388607u));
                int _e840 = (((_e833 > 1) ? _e833 : 1) & int((0u - ((_e703[0] > 0.0) ? 1u : 0u))));
                uint _e841 = uint(_e840);
                uint _e842 = (_e841 & 4294967295u);
                int _e844 = int((_e365.member_13 ? _e755 : _e803));
                uint _e848 = (0u - (((_e840 <= _e827) && (0 < _e844)) ? 1u : 0u));
                uint _e849 = (_e841 & _e848);
                int _e855 = int((floatBitsToUint(((_e703[1] * _e824) + 8388608.0)) & 8388607u));
                int _e860 = (_e840 + (((_e855 > 1) ? _e855 : 1) & int(_e760)));
                uint _e861 = uint(_e860);
                uint _e864 = (_e842 ^ ((_e861 ^ _e842) & _e848));
                uint _e869 = (0u - (((_e860 <= _e827) && (1 < _e844)) ? 1u : 0u));
                uint _e872 = (_e849 ^ ((_e861 ^ _e849) & _e869));
                int _e879 = int((floatBitsToUint(((_e703[2] * _e824) + 8388608.0)) & 8388607u));
                int _e884 = (_e860 + (((_e879 > 1) ? _e879 : 1) & int(_e765)));
                uint _e885 = uint(_e884);
                uint _e888 = (_e864 ^ ((_e885 ^ _e864) & _e869));
                uint _e893 = (0u - (((_e884 <= _e827) && (2 < _e844)) ? 1u : 0u));
                uint _e896 = (_e872 ^ ((_e885 ^ _e872) & _e893));
                int _e903 = int((floatBitsToUint(((_e703[3] * _e824) + 8388608.0)) & 8388607u));
                int _e908 = (_e884 + (((_e903 > 1) ? _e903 : 1) & int(_e772)));
                uint _e909 = uint(_e908);
                uint _e912 = (_e888 ^ ((_e909 ^ _e888) & _e893));
                uint _e917 = (0u - (((_e908 <= _e827) && (3 < _e844)) ? 1u : 0u));
                uint _e920 = (_e896 ^ ((_e909 ^ _e896) & _e917));
                int _e927 = int((floatBitsToUint(((_e703[4] * _e824) + 8388608.0)) & 8388607u));
                int _e932 = (_e908 + (((_e927 > 1) ? _e927 : 1) & int(_e779)));
                uint _e933 = uint(_e932);
                uint _e936 = (_e912 ^ ((_e933 ^ _e912) & _e917));
                uint _e941 = (0u - (((_e932 <= _e827) && (4 < _e844)) ? 1u : 0u));
                uint _e944 = (_e920 ^ ((_e933 ^ _e920) & _e941));
                int _e951 = int((floatBitsToUint(((_e703[5] * _e824) + 8388608.0)) & 8388607u));
                int _e956 = (_e932 + (((_e951 > 1) ? _e951 : 1) & int(_e786)));
                uint _e957 = uint(_e956);
                uint _e960 = (_e936 ^ ((_e957 ^ _e936) & _e941));
                uint _e965 = (0u - (((_e956 <= _e827) && (5 < _e844)) ? 1u : 0u));
                uint _e968 = (_e944 ^ ((_e957 ^ _e944) & _e965));
                int _e975 = int((floatBitsToUint(((_e703[6] * _e824) + 8388608.0)) & 8388607u));
                int _e980 = (_e956 + (((_e975 > 1) ? _e975 : 1) & int(_e793)));
                uint _e981 = uint(_e980);
                uint _e984 = (_e960 ^ ((_e981 ^ _e960) & _e965));
                uint _e989 = (0u - (((_e980 <= _e827) && (6 < _e844)) ? 1u : 0u));
                uint _e992 = (_e968 ^ ((_e981 ^ _e968) & _e989));
                int _e999 = int((floatBitsToUint(((_e703[7] * _e824) + 8388608.0)) & 8388607u));
                int _e1004 = (_e980 + (((_e999 > 1) ? _e999 : 1) & int(_e800)));
                uint _e1005 = uint(_e1004);
                uint _e1008 = (_e984 ^ ((_e1005 ^ _e984) & _e989));
                uint _e1013 = (0u - (((_e1004 <= _e827) && (7 < _e844)) ? 1u : 0u));
                uint _e1016 = (_e992 ^ ((_e1005 ^ _e992) & _e1013));
                uint _e1019 = (_e365.member_13 ? _e755 : ((((((((_e848 & 1u) + (_e869 & 1u)) + (_e893 & 1u)) + (_e917 & 1u)) + (_e941 & 1u)) + (_e965 & 1u)) + (_e989 & 1u)) + (_e1013 & 1u)));
                bool _e1024 = (_e1019 < 8u);
                bool _e1025 = ((_e807 && (_e1008 > _e1016)) && _e1024);
                uint _e1026 = (_e1024 ? _e1019 : 0u);
                v44_1 = 0u;
                if (_e1025) {
                    v44_1 = (((_e1019 == _e803) ? _e365.member_9 : _e1008) - _e1016);
                }
                uint _e1030 = v44_1;
                bool _e1031 = (_e1026 < 8u);
                if (_e1031) {
                } else {
                    v58_1 = true;
                    break;
                }
                uint _e1035 = lightbvh_nodes.list[_e370][1u][_e1026];
                uint _e1036 = (_e1035 & 3u);
                if (_e1031) {
                } else {
                    v58_1 = true;
                    break;
                }
                uint _e1040 = lightbvh_nodes.list[_e370][5u][_e1026];
                bool _e1044 = ((_e369 && (_e1030 > 0u)) && (_e1030 <= _e365.member_9));
                uint _e1045 = (_e1044 ? _e1030 : 1u);
                uint _e1047 = ((_e1045 - 1u) & 4194303u);
                uint _e1053 = (((_e1047 == 0u) ? 32u : (uint(31) - uint(findMSB(_e1047)))) - 10u);
                uint _e1055 = ((_e1053 < 22u) ? _e1053 : 22u);
                uint _e1067 = (_e1055 & 31u);
                LightbvhType26_ _e1088 = LightbvhType26_(_e365.member, LightbvhType23_((((_e365.member_1.member - ((_e1025 ? _e1016 : 0u) << 10u)) << _e1067) | ((_e365.member_1.member_1 >> uint(1)) >> ((31u - _e1055) & 31u))), (_e365.member_1.member_1 << _e1067)), _e365.member_2, _e365.member_3, _e365.member_4, _e365.member_5, _e365.member_6, _e365.member_7, _e365.member_8, _e365.member_9, _e365.member_10, _e365.member_11, _e365.member_12, _e365.member_13);
                LightbvhType26_ _e1105 = LightbvhType26_(_e1088.member, _e1088.member_1, _e1088.member_2, _e1088.member_3, _e1088.member_4, _e1088.member_5, _e1088.member_6, _e1088.member_7, _e1088.member_8, (_e1045 << _e1067), _e1088.member_10, _e1088.member_11, _e1088.member_12, _e1088.member_13);
                LightbvhType26_ _e1122 = LightbvhType26_(_e1105.member, _e1105.member_1, _e1105.member_2, _e1105.member_3, _e1105.member_4, _e1105.member_5, _e1105.member_6, _e1105.member_7, _e1105.member_8, _e1105.member_9, (_e365.member_10 + _e1055), _e1105.member_11, _e1105.member_12, _e1105.member_13);
                uint _e1123 = (_e365.member_8 + 1u);
                v45_1 = true;
                if ((_e1123 == 20u)) {
                } else {
                    v45_1 = (_e1123 == 40u);
                }
                bool _e1127 = v45_1;
                uint _e1128 = (_e1040 & 134217727u);
                uint _e1132 = (_e1040 >> (uint(findLSB(134217728u)) & 31u));
                bool _e1136 = (_e1128 < _e138);
                bool _e1137 = (((_e1044 && (_e1036 == 3u)) && _e720) && _e1136);
                bool _e1141 = ((_e1044 && (_e1036 == 1u)) && !(_e1127));
                LightbvhType26_ _e1159 = LightbvhType26_(_e1122.member, _e1122.member_1, _e1122.member_2, _e1122.member_3, _e1122.member_4, _e1122.member_5, ((_e1044 && (_e1036 == 2u)) ? _e1040 : 4294967295u), _e1122.member_7, _e1122.member_8, _e1122.member_9, _e1122.member_10, _e1122.member_11, _e1122.member_12, _e1122.member_13);
                uint _e1161 = (_e365.member_11 - 1u);
                LightbvhType26_ _e1176 = LightbvhType26_(_e1159.member, _e1159.member_1, _e1159.member_2, _e1159.member_3, _e1159.member_4, _e1159.member_5, _e1159.member_6, _e1159.member_7, _e1159.member_8, _e1159.member_9, _e1159.member_10, _e1161, _e1159.member_12, _e1159.member_13);
                bool _e1180 = (!((_e1137 || _e1141)) || (_e1161 == 0u));
                LightbvhType26_ _e1195 = LightbvhType26_(_e1176.member, _e1176.member_1, _e1176.member_2, _e1176.member_3, _e1176.member_4, _e1176.member_5, _e1176.member_6, _e1176.member_7, _e1176.member_8, _e1176.member_9, _e1176.member_10, _e1176.member_11, _e1180, _e1176.member_13);
                v46_1 = LightbvhType26_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType14_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, 0u, false, false);
                if (_e1137) {
                    if (_e1136) {
                    } else {
                        v58_1 = true;
                        break;
                    }
                    LightbvhType26_ _e1248 = LightbvhType26_(_e1195.member, _e1195.member_1, _e1195.member_2, _e1195.member_3, _e1195.member_4, _e1195.member_5, _e1195.member_6, _e1128, _e1195.member_8, _e1195.member_9, _e1195.member_10, _e1195.member_11, _e1195.member_12, _e1195.member_13);
                    uint _e1251 = lightbvh_instances.list[_e1128].root;
                    LightbvhType26_ _e1266 = LightbvhType26_(_e1248.member, _e1248.member_1, _e1248.member_2, _e1248.member_3, _e1248.member_4, _e1251, _e1248.member_6, _e1248.member_7, _e1248.member_8, _e1248.member_9, _e1248.member_10, _e1248.member_11, _e1248.member_12, _e1248.member_13);
                    bool _e1267 = (_e1251 == 4294967295u);
                    v48_1 = 4294967295u;
                    if (_e1267) {
                        uint _e1270 = lightbvh_instances.list[_e1128].first_light;
                        v48_1 = _e1270;
                    }
                    uint _e1272 = v48_1;
                    LightbvhType26_ _e1287 = LightbvhType26_(_e1266.member, _e1266.member_1, _e1266.member_2, _e1266.member_3, _e1266.member_4, _e1266.member_5, _e1272, _e1266.member_7, _e1266.member_8, _e1266.member_9, _e1266.member_10, _e1266.member_11, _e1266.member_12, _e1266.member_13);
                    bool _e1288 = (_e1180 || _e1267);
                    LightbvhType26_ _e1303 = LightbvhType26_(_e1287.member, _e1287.member_1, _e1287.member_2, _e1287.member_3, _e1287.member_4, _e1287.member_5, _e1287.member_6, _e1287.member_7, _e1287.member_8, _e1287.member_9, _e1287.member_10, _e1287.member_11, _e1288, _e1287.member_13);
                    LightbvhType26_ _e1318 = LightbvhType26_(_e1303.member, _e1303.member_1, _e1303.member_2, _e1303.member_3, _e1303.member_4, _e1303.member_5, _e1303.member_6, _e1303.member_7, 20u, _e1303.member_9, _e1303.member_10, _e1303.member_11, _e1303.member_12, _e1303.member_13);
                    v49_1 = _e1318;
                    if ((_e1132 > 0u)) {
                        uint _e1321 = ((_e1251 < _e135) ? _e1251 : 0u);
                        if ((_e1321 < _e135)) {
                        } else {
                            v58_1 = true;
                            break;
                        }
                        uint _e1324 = ((_e1132 - 1u) % 8u);
                        bool _e1325 = (_e1324 < 8u);
                        if (_e1325) {
                        } else {
                            v58_1 = true;
                            break;
                        }
                        uint _e1329 = lightbvh_nodes.list[_e1321][1u][_e1324];
                        uint _e1330 = (_e1329 & 3u);
                        if (_e1325) {
                        } else {
                            v58_1 = true;
                            break;
                        }
                        uint _e1334 = lightbvh_nodes.list[_e1321][5u][_e1324];
                        LightbvhType26_ _e1349 = LightbvhType26_(_e1318.member, _e1318.member_1, _e1318.member_2, _e1318.member_3, _e1318.member_4, _e1334, _e1318.member_6, _e1318.member_7, _e1318.member_8, _e1318.member_9, _e1318.member_10, _e1318.member_11, _e1318.member_12, _e1318.member_13);
                        LightbvhType26_ _e1366 = LightbvhType26_(_e1349.member, _e1349.member_1, _e1349.member_2, _e1349.member_3, _e1349.member_4, _e1349.member_5, ((_e1330 == 2u) ? _e1334 : 4294967295u), _e1349.member_7, _e1349.member_8, _e1349.member_9, _e1349.member_10, _e1349.member_11, _e1349.member_12, _e1349.member_13);
                        LightbvhType26_ _e1383 = LightbvhType26_(_e1366.member, _e1366.member_1, _e1366.member_2, _e1366.member_3, _e1366.member_4, _e1366.member_5, _e1366.member_6, _e1366.member_7, _e1366.member_8, _e1366.member_9, _e1366.member_10, _e1366.member_11, (_e1288 || (_e1330 != 1u)), _e1366.member_13);
                        v49_1 = LightbvhType26_(_e1383.member, _e1383.member_1, _e1383.member_2, _e1383.member_3, _e1383.member_4, _e1383.member_5, _e1383.member_6, _e1383.member_7, 21u, _e1383.member_9, _e1383.member_10, _e1383.member_11, _e1383.member_12, _e1383.member_13);
                    }
                    LightbvhType26_ _e1400 = v49_1;
                    float _e1410 = lightbvh_instances.list[_e1128].translation[0u];
                    float _e1414 = lightbvh_instances.list[_e1128].translation[1u];
                    float _e1418 = lightbvh_instances.list[_e1128].translation[2u];
                    float _e1419 = (_e170.member.member[0] - _e1410);
                    float _e1420 = (_e170.member.member[1] - _e1414);
                    float _e1421 = (_e170.member.member[2] - _e1418);
                    float _e1426 = ((uintBitsToFloat((floatBitsToUint(_e1419) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1419);
                    float _e1431 = ((uintBitsToFloat((floatBitsToUint(_e1420) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1420);
                    float _e1436 = ((uintBitsToFloat((floatBitsToUint(_e1421) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1421);
                    float _e1441 = lightbvh_instances.list[_e1128].inverse_[0u][0u];
                    float _e1446 = lightbvh_instances.list[_e1128].inverse_[0u][1u];
                    float _e1451 = lightbvh_instances.list[_e1128].inverse_[0u][2u];
                    float _e1459 = lightbvh_instances.list[_e1128].inverse_[1u][0u];
                    float _e1464 = lightbvh_instances.list[_e1128].inverse_[1u][1u];
                    float _e1469 = lightbvh_instances.list[_e1128].inverse_[1u][2u];
                    float _e1480 = lightbvh_instances.list[_e1128].inverse_[2u][0u];
                    float _e1485 = lightbvh_instances.list[_e1128].inverse_[2u][1u];
                    float _e1490 = lightbvh_instances.list[_e1128].inverse_[2u][2u];
                    float _e1494 = (((_e1441 * _e1426) + (_e1459 * _e1431)) + (_e1480 * _e1436));
                    float _e1495 = (((_e1446 * _e1426) + (_e1464 * _e1431)) + (_e1485 * _e1436));
                    float _e1496 = (((_e1451 * _e1426) + (_e1469 * _e1431)) + (_e1490 * _e1436));
                    float _e1507 = lightbvh_instances.list[_e1128].columns[0u][0u];
                    float _e1512 = lightbvh_instances.list[_e1128].columns[0u][1u];
                    float _e1517 = lightbvh_instances.list[_e1128].columns[0u][2u];
                    float _e1522 = (((_e1507 * _e170.member.member_1[0]) + (_e1512 * _e170.member.member_1[1])) + (_e1517 * _e170.member.member_1[2]));
                    float _e1527 = lightbvh_instances.list[_e1128].columns[1u][0u];
                    float _e1532 = lightbvh_instances.list[_e1128].columns[1u][1u];
                    float _e1537 = lightbvh_instances.list[_e1128].columns[1u][2u];
                    float _e1542 = (((_e1527 * _e170.member.member_1[0]) + (_e1532 * _e170.member.member_1[1])) + (_e1537 * _e170.member.member_1[2]));
                    float _e1547 = lightbvh_instances.list[_e1128].columns[2u][0u];
                    float _e1552 = lightbvh_instances.list[_e1128].columns[2u][1u];
                    float _e1557 = lightbvh_instances.list[_e1128].columns[2u][2u];
                    float _e1562 = (((_e1547 * _e170.member.member_1[0]) + (_e1552 * _e170.member.member_1[1])) + (_e1557 * _e170.member.member_1[2]));
                    float _e1567 = ((uintBitsToFloat((floatBitsToUint(_e1522) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1522);
                    float _e1572 = ((uintBitsToFloat((floatBitsToUint(_e1542) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1542);
                    float _e1577 = ((uintBitsToFloat((floatBitsToUint(_e1562) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1562);
                    float _e1582 = (((_e1567 * _e1567) + (_e1572 * _e1572)) + (_e1577 * _e1577));
                    v50_1 = 0.0;
                    if ((_e1582 >= uintBitsToFloat(67108864u))) {
                        float _e1589 = uintBitsToFloat((1597463007u - (floatBitsToUint(_e1582) >> uint(1))));
                        float _e1590 = (0.5 * _e1582);
                        float _e1594 = (_e1589 * (1.5 - ((_e1590 * _e1589) * _e1589)));
                        v50_1 = (_e1594 * (1.5 - ((_e1590 * _e1594) * _e1594)));
                    }
                    float _e1600 = v50_1;
                    float _e1601 = -(1.1529215e18);
                    v51_1 = _e1601;
                    if ((_e1494 < _e1601)) {
                    } else {
                        v51_1 = ((_e1494 > 1.1529215e18) ? 1.1529215e18 : _e1494);
                    }
                    float _e1606 = v51_1;
                    v52_1 = _e1601;
                    if ((_e1495 < _e1601)) {
                    } else {
                        v52_1 = ((_e1495 > 1.1529215e18) ? 1.1529215e18 : _e1495);
                    }
                    float _e1616 = v52_1;
                    v53_1 = _e1601;
                    if ((_e1496 < _e1601)) {
                    } else {
                        v53_1 = ((_e1496 > 1.1529215e18) ? 1.1529215e18 : _e1496);
                    }
                    float _e1626 = v53_1;
                    float _e1633 = (_e1567 * _e1600);
                    float _e1639 = (_e1572 * _e1600);
                    float _e1645 = (_e1577 * _e1600);
                    v46_1 = LightbvhType26_(_e1400.member, _e1400.member_1, LightbvhType14_(float[3](((uintBitsToFloat((floatBitsToUint(_e1606) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1606), ((uintBitsToFloat((floatBitsToUint(_e1616) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1616), ((uintBitsToFloat((floatBitsToUint(_e1626) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1626)), float[3](((uintBitsToFloat((floatBitsToUint(_e1633) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1633), ((uintBitsToFloat((floatBitsToUint(_e1639) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1639), ((uintBitsToFloat((floatBitsToUint(_e1645) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1645))), _e1400.member_3, _e1400.member_4, _e1400.member_5, _e1400.member_6, _e1400.member_7, _e1400.member_8, _e1400.member_9, _e1400.member_10, _e1400.member_11, _e1400.member_12, _e1400.member_13);
                }
                LightbvhType26_ _e1197 = v46_1;
                v54_1 = _e1197;
                if (_e1137) {
                } else {
                    v47_1 = _e365.member_5;
                    if (_e1141) {
                        v47_1 = (_e1040 + (_e720 ? _e144 : 0u));
                    }
                    uint _e1201 = v47_1;
                    LightbvhType26_ _e1216 = LightbvhType26_(_e1195.member, _e1195.member_1, _e1195.member_2, _e1195.member_3, _e1195.member_4, _e1201, _e1195.member_6, _e1195.member_7, _e1195.member_8, _e1195.member_9, _e1195.member_10, _e1195.member_11, _e1195.member_12, _e1195.member_13);
                    v54_1 = LightbvhType26_(_e1216.member, _e1216.member_1, _e1216.member_2, _e1216.member_3, _e1216.member_4, _e1216.member_5, _e1216.member_6, _e1216.member_7, (_e365.member_8 + (_e1141 ? 1u : 0u)), _e1216.member_9, _e1216.member_10, _e1216.member_11, _e1216.member_12, _e1216.member_13);
                }
                LightbvhType26_ _e1669 = v54_1;
                v55_1 = _e702;
                v56_1 = _e1669;
                v57_1 = _e1669.member_12;
            }
            bool _e1672 = v55_1;
            LightbvhType26_ _e1674 = v56_1;
            bool _e1676 = v57_1;
            continue;
        }
        bool _e1680 = v58_1;
        if (_e1680) {
            break;
        }
        LightbvhType26_ _e1682 = v59_1;
        LightbvhType26_ _e1686 = v60_1;
        v63_1 = 0.0;
        if ((((_e1682.member_6 == _e194) && (_e1686.member_7 == _e177)) && (_e194 != 4294967295u))) {
            LightbvhType26_ _e1693 = v61_1;
            LightbvhType26_ _e1698 = v62_1;
            int _e1704 = -(int((22u + ((_e1693.member_10 < 98u) ? _e1693.member_10 : 98u))));
            int _e1706 = ((_e1704 < -126) ? -126 : _e1704);
            v63_1 = (float(int(_e1698.member_9)) * uintBitsToFloat((uint((((_e1706 > 127) ? 127 : _e1706) + 127)) << uint(23))));
        }
        float _e1716 = v63_1;
        v65_1 = 0u;
        v66_1 = true;
        if (_e176) {
            v64_1 = 0u;
            if (_e178) {
                if (_e178) {
                } else {
                    break;
                }
                uint _e1719 = lightbvh_instances.list[_e177].count;
                v64_1 = _e1719;
            }
            uint _e1721 = v64_1;
            v65_1 = _e1721;
            v66_1 = (_e178 ? false : true);
        }
        uint _e1724 = v65_1;
        bool _e1726 = v66_1;
        uint _e1731 = ((_e1726 ? _e165 : _e1724) & 2147483647u);
        uint _e1736 = floatBitsToUint((float(65536) * uintBitsToFloat(880803840u)));
        uint _e1737 = floatBitsToUint(float(int(((_e1731 > 0u) ? _e1731 : 1u))));
        uint _e1742 = ((_e1736 >> uint(23)) & 255u);
        uint _e1746 = (_e1736 & 8388607u);
        uint _e1747 = (_e1746 | 8388608u);
        uint _e1748 = (_e1737 & 8388607u);
        uint _e1749 = (_e1748 | 8388608u);
        bool _e1750 = (_e1747 < _e1749);
        float _e1754 = uintBitsToFloat((_e1748 | 1065353216u));
        uint _e1755 = floatBitsToUint(_e1754);
        float _e1760 = uintBitsToFloat(((_e1755 & 2147483648u) | (2129859015u - (_e1755 & 2147483647u))));
        float _e1763 = (_e1760 * (2.0 - (_e1754 * _e1760)));
        float _e1766 = (_e1763 * (2.0 - (_e1754 * _e1763)));
        float _e1770 = ((uintBitsToFloat((_e1746 | 1065353216u)) * _e1766) * (_e1750 ? 16777216.0 : 8388608.0));
        float _e1771 = uintBitsToFloat(0u);
        float _e1772 = uintBitsToFloat(1333788671u);
        uint _e1777 = ((_e1770 > _e1772) ? 4294967295u : ((_e1770 < _e1771) ? 0u : uint(_e1770)));
        int _e1783 = int(((_e1747 << uint(((_e1750 ? 24 : 23) & 31))) - (_e1777 * _e1749)));
        float _e1788 = ((float((_e1783 >> uint(8))) * _e1766) * 3.0517578e-5);
        float _e1789 = uintBitsToFloat(3472883712u);
        float _e1790 = uintBitsToFloat(1325400063u);
        int _e1797 = ((_e1788 == _e1788) ? ((_e1788 > _e1790) ? 2147483647 : ((_e1788 < _e1789) ? -2147483648 : int(_e1788))) : 0);
        uint _e1799 = (_e1777 + uint(_e1797));
        int _e1800 = int(_e1749);
        int _e1802 = (_e1783 - (_e1797 * _e1800));
        bool _e1803 = (_e1802 < 0);
        v67_1 = _e1799;
        if (_e1803) {
            v67_1 = (_e1799 - 1u);
        }
        uint _e1806 = v67_1;
        v68_1 = _e1802;
        if (_e1803) {
            v68_1 = (_e1802 + _e1800);
        }
        int _e1809 = v68_1;
        bool _e1810 = (_e1809 >= _e1800);
        v69_1 = _e1806;
        if (_e1810) {
            v69_1 = (_e1806 + 1u);
        }
        uint _e1813 = v69_1;
        v70_1 = _e1809;
        if (_e1810) {
            v70_1 = (_e1809 - _e1800);
        }
        int _e1816 = v70_1;
        v71_1 = _e1813;
        if (((_e1816 * 2) > _e1800)) {
            v71_1 = (_e1813 + 1u);
        }
        uint _e1821 = v71_1;
        int _e1826 = ((int(_e1742) - int(((_e1737 >> uint(23)) & 255u))) + (_e1750 ? 126 : 127));
        v74_1 = 0u;
        v75_1 = true;
        if ((_e1742 == 0u)) {
        } else {
            bool _e1828 = (_e1826 <= 0);
            v73_1 = 0u;
            if (_e1828) {
            } else {
                v72_1 = 2139095040u;
                if ((_e1826 >= 255)) {
                } else {
                    v72_1 = ((uint(_e1826) << uint(23)) + (_e1821 & 8388607u));
                }
                uint _e1836 = v72_1;
                v73_1 = _e1836;
            }
            uint _e1838 = v73_1;
            v74_1 = _e1838;
            v75_1 = _e1828;
        }
        uint _e1840 = v74_1;
        bool _e1842 = v75_1;
        uint _e1846 = (_e162 & 2147483647u);
        uint _e1851 = floatBitsToUint(uintBitsToFloat((((_e1736 ^ _e1737) & 2147483648u) | (_e1842 ? 0u : _e1840))));
        uint _e1852 = floatBitsToUint(float(int(((_e1846 > 0u) ? _e1846 : 1u))));
        uint _e1857 = ((_e1851 >> uint(23)) & 255u);
        uint _e1861 = (_e1851 & 8388607u);
        uint _e1862 = (_e1861 | 8388608u);
        uint _e1863 = (_e1852 & 8388607u);
        uint _e1864 = (_e1863 | 8388608u);
        bool _e1865 = (_e1862 < _e1864);
        float _e1869 = uintBitsToFloat((_e1863 | 1065353216u));
        uint _e1870 = floatBitsToUint(_e1869);
        float _e1875 = uintBitsToFloat(((_e1870 & 2147483648u) | (2129859015u - (_e1870 & 2147483647u))));
        float _e1878 = (_e1875 * (2.0 - (_e1869 * _e1875)));
        float _e1881 = (_e1878 * (2.0 - (_e1869 * _e1878)));
        float _e1885 = ((uintBitsToFloat((_e1861 | 1065353216u)) * _e1881) * (_e1865 ? 16777216.0 : 8388608.0));
        uint _e1890 = ((_e1885 > _e1772) ? 4294967295u : ((_e1885 < _e1771) ? 0u : uint(_e1885)));
        int _e1896 = int(((_e1862 << uint(((_e1865 ? 24 : 23) & 31))) - (_e1890 * _e1864)));
        float _e1901 = ((float((_e1896 >> uint(8))) * _e1881) * 3.0517578e-5);
        int _e1908 = ((_e1901 == _e1901) ? ((_e1901 > _e1790) ? 2147483647 : ((_e1901 < _e1789) ? -2147483648 : int(_e1901))) : 0);
        uint _e1910 = (_e1890 + uint(_e1908));
        int _e1911 = int(_e1864);
        int _e1913 = (_e1896 - (_e1908 * _e1911));
        bool _e1914 = (_e1913 < 0);
        v76_1 = _e1910;
        if (_e1914) {
            v76_1 = (_e1910 - 1u);
        }
        uint _e1917 = v76_1;
        v77_1 = _e1913;
        if (_e1914) {
            v77_1 = (_e1913 + _e1911);
        }
        int _e1920 = v77_1;
        bool _e1921 = (_e1920 >= _e1911);
        v78_1 = _e1917;
        if (_e1921) {
            v78_1 = (_e1917 + 1u);
        }
        uint _e1924 = v78_1;
        v79_1 = _e1920;
        if (_e1921) {
            v79_1 = (_e1920 - _e1911);
        }
        int _e1927 = v79_1;
        v80_1 = _e1924;
        if (((_e1927 * 2) > _e1911)) {
            v80_1 = (_e1924 + 1u);
        }
        uint _e1932 = v80_1;
        int _e1937 = ((int(_e1857) - int(((_e1852 >> uint(23)) & 255u))) + (_e1865 ? 126 : 127));
        v83_1 = 0u;
        v84_1 = true;
        if ((_e1857 == 0u)) {
        } else {
            bool _e1939 = (_e1937 <= 0);
            v82_1 = 0u;
            if (_e1939) {
            } else {
                v81_1 = 2139095040u;
                if ((_e1937 >= 255)) {
                } else {
                    v81_1 = ((uint(_e1937) << uint(23)) + (_e1932 & 8388607u));
                }
                uint _e1947 = v81_1;
                v82_1 = _e1947;
            }
            uint _e1949 = v82_1;
            v83_1 = _e1949;
            v84_1 = _e1939;
        }
        uint _e1951 = v83_1;
        bool _e1953 = v84_1;
        v85_1 = false;
        if (_e176) {
            v86_1 = false;
            if (_e178) {
                if (_e178) {
                } else {
                    break;
                }
                uint _e1962 = lightbvh_instances.list[_e177].first;
                uint _e1966 = lightbvh_instances.list[_e177].count;
                v86_1 = ((_e170.member_1[0] - _e1962) < _e1966);
            }
            bool _e1969 = v86_1;
            v85_1 = _e1969;
        }
        bool _e1958 = v85_1;
        v87_1 = _e1958;
        if (_e176) {
        } else {
            v87_1 = (_e170.member_1[0] < _e165);
        }
        bool _e1971 = v87_1;
        v88_1 = 0.0;
        if (_e1971) {
            v88_1 = (_e1716 + uintBitsToFloat((((_e1851 ^ _e1852) & 2147483648u) | (_e1953 ? 0u : _e1951))));
        }
        float _e1974 = v88_1;
        results_1 = _e1974;
        break;
    } while(false);
    float _e2065 = results_1;
    return _e2065;
}

LightbvhLightSample lightbvh_sample_cell(vec3 center, vec3 half_, vec3 n_2, uvec2 number_1) {
    LightbvhType30_ queries_2 = LightbvhType30_(LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), uint[2](0u, 0u));
    LightbvhType19_ results_2 = LightbvhType19_(0u, 0u, 0.0);
    float v0_2[8] = float[8](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    uint v1_2 = 0u;
    uint v2_2 = 0u;
    uint v3_2 = 0u;
    uint v4_2 = 0u;
    uint v5_2 = 0u;
    uint v6_2 = 0u;
    uint v7_2 = 0u;
    uint v8_2 = 0u;
    uint v9_2 = 0u;
    uint v10_2 = 0u;
    uint v11_2 = 0u;
    uint v12_2 = 0u;
    bool v13_2 = false;
    uint v14_2 = 0u;
    uint v15_2 = 0u;
    uint v16_2 = 0u;
    bool v17_2 = false;
    bool v18_2 = false;
    LightbvhType24_ v19_2 = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
    uint v20_2 = 0u;
    uint v21_2 = 0u;
    uint v22_2 = 0u;
    uint v23_2 = 0u;
    bool v24_2 = false;
    uint v25_2 = 0u;
    LightbvhType23_ v26_2 = LightbvhType23_(0u, 0u);
    uint v27_2 = 0u;
    uint v28_2 = 0u;
    uint v29_2 = 0u;
    LightbvhType23_ v30_2 = LightbvhType23_(0u, 0u);
    uint v31_2 = 0u;
    uint v32_2 = 0u;
    LightbvhType23_ v33_2 = LightbvhType23_(0u, 0u);
    uint v34_2 = 0u;
    bool v35_2 = false;
    bool v36_2 = false;
    LightbvhType23_ v37_2 = LightbvhType23_(0u, 0u);
    bool v38_2 = false;
    LightbvhType24_ v39_2 = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
    bool v40_2 = false;
    LightbvhType24_ v41_2 = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
    uint v42_2 = 0u;
    uint v43_2 = 0u;
    bool v44_2 = false;
    LightbvhType32_ v45_2 = LightbvhType32_(0u, 0u, LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false));
    bool v46_2 = false;
    LightbvhType23_ v47_2 = LightbvhType23_(0u, 0u);
    LightbvhType23_ v48_2 = LightbvhType23_(0u, 0u);
    LightbvhType23_ v49_2 = LightbvhType23_(0u, 0u);
    LightbvhType23_ v50_2 = LightbvhType23_(0u, 0u);
    LightbvhType23_ v51_2 = LightbvhType23_(0u, 0u);
    bool v52_2 = false;
    uint v53_2 = 0u;
    uint v54_2 = 0u;
    uint v55_2 = 0u;
    uint v56_2 = 0u;
    int v57_2 = 0;
    uint v58_2 = 0u;
    bool v59_2 = false;
    LightbvhType32_ v60_2 = LightbvhType32_(0u, 0u, LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false));
    uint v61_2 = 0u;
    uint v62_2 = 0u;
    LightbvhType32_ v63_2 = LightbvhType32_(0u, 0u, LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false));
    float v64_2 = 0.0;
    float v65_2 = 0.0;
    float v66_2 = 0.0;
    float v67_2 = 0.0;
    LightbvhType32_ v68_2 = LightbvhType32_(0u, 0u, LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false));
    bool v69_2 = false;
    LightbvhType32_ v70_2 = LightbvhType32_(0u, 0u, LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false));
    bool v71_2 = false;
    bool v72_2 = false;
    LightbvhType32_ v73_2 = LightbvhType32_(0u, 0u, LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false));
    LightbvhType32_ v74_2 = LightbvhType32_(0u, 0u, LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false));
    LightbvhType32_ v75_2 = LightbvhType32_(0u, 0u, LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false));
    LightbvhType32_ v76_2 = LightbvhType32_(0u, 0u, LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false));
    uint v77_2 = 0u;
    uint v78_2 = 0u;
    LightbvhType32_ v79_2 = LightbvhType32_(0u, 0u, LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false));
    LightbvhType32_ v80_2 = LightbvhType32_(0u, 0u, LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false));
    float v81_2 = 0.0;
    uint v82_2 = 0u;
    uint v83_2 = 0u;
    bool v84_2 = false;
    uint v85_2 = 0u;
    int v86_2 = 0;
    uint v87_2 = 0u;
    int v88_2 = 0;
    uint v89_1 = 0u;
    uint v90_1 = 0u;
    uint v91_1 = 0u;
    uint v92_1 = 0u;
    bool v93_1 = false;
    uint v94_1 = 0u;
    int v95_1 = 0;
    uint v96_1 = 0u;
    int v97_1 = 0;
    uint v98_1 = 0u;
    uint v99_1 = 0u;
    uint v100_1 = 0u;
    uint v101_1 = 0u;
    bool v102_1 = false;
    LightbvhType19_ v103_1 = LightbvhType19_(0u, 0u, 0.0);
    queries_2 = LightbvhType30_(LightbvhType29_(float[3](center.x, center.y, center.z), float[3](half_.x, half_.y, half_.z), float[3](n_2.x, n_2.y, n_2.z)), uint[2](number_1.x, number_1.y));
    do {
        uint _e148 = uint(lightbvh_nodes.list.length());
        uint _e151 = uint(lightbvh_instances.list.length());
        uint _e154 = uint(lightbvh_trails.list.length());
        uint _e157 = lightbvh_tree.top;
        uint _e160 = lightbvh_tree.root;
        uint _e163 = lightbvh_tree.above;
        uint _e166 = lightbvh_tree.places;
        uint _e169 = lightbvh_tree.parts;
        uint _e172 = lightbvh_tree.trail_words;
        uint _e175 = lightbvh_tree.live;
        uint _e178 = lightbvh_tree.lights;
        uint _e181 = lightbvh_tree.depth;
        LightbvhType30_ _e183 = queries_2;
        v40_2 = false;
        v41_2 = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
        v42_2 = 4294967295u;
        v43_2 = 4294967295u;
        if (((_e183.member_1[0] >> 10u) < 65536u)) {
            uint _e198 = ((_e183.member_1[0] << 6u) | ((_e183.member_1[1] >> uint(1)) >> 25u));
            uint _e200 = (_e183.member_1[1] << 6u);
            bool _e201 = (_e175 > 0u);
            v1_2 = 0u;
            v2_2 = 0u;
            if (_e201) {
                uint _e254 = (_e200 >> uint(16));
                uint _e255 = (_e200 & 65535u);
                uint _e257 = (_e175 >> uint(16));
                uint _e258 = (_e175 & 65535u);
                uint _e263 = ((_e254 * _e258) + ((_e255 * _e258) >> uint(16)));
                uint _e274 = (_e200 * _e175);
                uint _e276 = (_e198 >> uint(16));
                uint _e277 = (_e198 & 65535u);
                uint _e282 = ((_e276 * _e258) + ((_e277 * _e258) >> uint(16)));
                uint _e293 = (_e198 * _e175);
                uint _e294 = (_e293 + (((_e254 * _e257) + (_e263 >> uint(16))) + (((_e255 * _e257) + (_e263 & 65535u)) >> uint(16))));
                uint _e297 = ((((_e276 * _e257) + (_e282 >> uint(16))) + (((_e277 * _e257) + (_e282 & 65535u)) >> uint(16))) + ((_e294 < _e293) ? 1u : 0u));
                bool _e298 = (_e297 < _e151);
                v7_2 = 4294967295u;
                v8_2 = 4294967295u;
                if (_e298) {
                    if (_e298) {
                    } else {
                        break;
                    }
                    uint _e301 = lightbvh_instances.list[_e297].listed;
                    bool _e302 = (_e301 < _e151);
                    v5_2 = 4294967295u;
                    v6_2 = 4294967295u;
                    if (_e302) {
                        if (_e302) {
                        } else {
                            break;
                        }
                        uint _e305 = lightbvh_instances.list[_e301].count;
                        bool _e306 = (_e305 > 0u);
                        v4_2 = 4294967295u;
                        if (_e306) {
                            uint _e309 = lightbvh_instances.list[_e301].first;
                            uint _e311 = (_e274 >> uint(16));
                            uint _e312 = (_e274 & 65535u);
                            uint _e314 = (_e305 >> uint(16));
                            uint _e315 = (_e305 & 65535u);
                            uint _e320 = ((_e311 * _e315) + ((_e312 * _e315) >> uint(16)));
                            uint _e332 = (_e294 >> uint(16));
                            uint _e333 = (_e294 & 65535u);
                            uint _e338 = ((_e332 * _e315) + ((_e333 * _e315) >> uint(16)));
                            uint _e349 = (_e294 * _e305);
                            v4_2 = (_e309 + ((((_e332 * _e314) + (_e338 >> uint(16))) + (((_e333 * _e314) + (_e338 & 65535u)) >> uint(16))) + (((_e349 + (((_e311 * _e314) + (_e320 >> uint(16))) + (((_e312 * _e314) + (_e320 & 65535u)) >> uint(16)))) < _e349) ? 1u : 0u)));
                        }
                        uint _e356 = v4_2;
                        v5_2 = _e356;
                        v6_2 = (_e306 ? _e301 : 4294967295u);
                    }
                    uint _e359 = v5_2;
                    uint _e361 = v6_2;
                    v7_2 = _e359;
                    v8_2 = _e361;
                }
                uint _e363 = v7_2;
                uint _e365 = v8_2;
                v1_2 = _e363;
                v2_2 = _e365;
            }
            uint _e203 = v1_2;
            uint _e205 = v2_2;
            v9_2 = _e203;
            v10_2 = _e205;
            if (_e201) {
            } else {
                v3_2 = 4294967295u;
                if ((_e178 > 0u)) {
                    uint _e208 = (_e200 >> uint(16));
                    uint _e209 = (_e200 & 65535u);
                    uint _e211 = (_e178 >> uint(16));
                    uint _e212 = (_e178 & 65535u);
                    uint _e217 = ((_e208 * _e212) + ((_e209 * _e212) >> uint(16)));
                    uint _e229 = (_e198 >> uint(16));
                    uint _e230 = (_e198 & 65535u);
                    uint _e235 = ((_e229 * _e212) + ((_e230 * _e212) >> uint(16)));
                    uint _e246 = (_e198 * _e178);
                    v3_2 = ((((_e229 * _e211) + (_e235 >> uint(16))) + (((_e230 * _e211) + (_e235 & 65535u)) >> uint(16))) + (((_e246 + (((_e208 * _e211) + (_e217 >> uint(16))) + (((_e209 * _e211) + (_e217 & 65535u)) >> uint(16)))) < _e246) ? 1u : 0u));
                }
                uint _e252 = v3_2;
                v9_2 = _e252;
                v10_2 = 4294967295u;
            }
            uint _e367 = v9_2;
            uint _e369 = v10_2;
            bool _e370 = (_e369 < _e151);
            v12_2 = 0u;
            v13_2 = true;
            if (_e370) {
                v11_2 = 0u;
                if (_e201) {
                    if (_e370) {
                    } else {
                        break;
                    }
                    uint _e373 = lightbvh_instances.list[_e369].first;
                    uint _e377 = lightbvh_instances.list[_e369].first_light;
                    v11_2 = ((_e367 - _e373) + _e377);
                }
                uint _e380 = v11_2;
                v12_2 = _e380;
                v13_2 = (_e201 ? false : true);
            }
            uint _e383 = v12_2;
            bool _e385 = v13_2;
            uint _e387 = ((_e385 ? _e367 : _e383) * _e172);
            bool _e388 = (_e387 < _e154);
            v14_2 = 0u;
            if (_e388) {
                if (_e388) {
                } else {
                    break;
                }
                uint _e390 = lightbvh_trails.list[_e387];
                v14_2 = _e390;
            }
            uint _e392 = v14_2;
            v16_2 = 0u;
            v17_2 = true;
            if ((_e172 == 2u)) {
                uint _e394 = (_e387 + 1u);
                bool _e395 = (_e394 < _e154);
                v15_2 = 0u;
                if (_e395) {
                    if (_e395) {
                    } else {
                        break;
                    }
                    uint _e397 = lightbvh_trails.list[_e394];
                    v15_2 = _e397;
                }
                uint _e399 = v15_2;
                v16_2 = _e399;
                v17_2 = (_e395 ? false : true);
            }
            uint _e402 = v16_2;
            bool _e404 = v17_2;
            uint _e405 = (_e404 ? 0u : _e402);
            v18_2 = false;
            v19_2 = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
            if (_e370) {
                uint _e412 = (_e166 + _e369);
                bool _e413 = (_e412 < _e154);
                v20_2 = 4294967295u;
                if (_e413) {
                    if (_e413) {
                    } else {
                        break;
                    }
                    uint _e415 = lightbvh_trails.list[_e412];
                    v20_2 = _e415;
                }
                uint _e417 = v20_2;
                v23_2 = 0u;
                v24_2 = true;
                if ((_e417 != 4294967295u)) {
                    bool _e419 = (_e417 >= 2147483648u);
                    v22_2 = 0u;
                    if (_e419) {
                        uint _e423 = (_e169 + ((_e417 - 2147483648u) + (_e392 & 7u)));
                        bool _e424 = (_e423 < _e154);
                        v21_2 = 4294967295u;
                        if (_e424) {
                            if (_e424) {
                            } else {
                                break;
                            }
                            uint _e426 = lightbvh_trails.list[_e423];
                            v21_2 = _e426;
                        }
                        uint _e428 = v21_2;
                        v22_2 = _e428;
                    }
                    uint _e430 = v22_2;
                    v23_2 = _e430;
                    v24_2 = (_e419 ? false : true);
                }
                uint _e433 = v23_2;
                bool _e435 = v24_2;
                v25_2 = 0u;
                v26_2 = LightbvhType23_(0u, 0u);
                v27_2 = (_e435 ? _e417 : _e433);
                bool loop_init_6 = true;
                while(true) {
                    if (!loop_init_6) {
                        v25_2 = v32_2;
                        v26_2 = v33_2;
                        v27_2 = v34_2;
                        v36_2 = false;
                        if (!(v35_2)) {
                            break;
                        }
                    }
                    loop_init_6 = false;
                    uint _e438 = v25_2;
                    LightbvhType23_ _e440 = v26_2;
                    uint _e442 = v27_2;
                    v37_2 = _e440;
                    v32_2 = 0u;
                    v33_2 = LightbvhType23_(0u, 0u);
                    v34_2 = 0u;
                    v35_2 = false;
                    if ((_e442 < 2147483648u)) {
                        bool _e444 = (_e438 < 20u);
                        v29_2 = 0u;
                        v30_2 = LightbvhType23_(0u, 0u);
                        v31_2 = 0u;
                        if (_e444) {
                            uint _e463 = (_e163 + (_e442 >> 3u));
                            bool _e464 = (_e463 < _e154);
                            v28_2 = 4294967295u;
                            if (_e464) {
                                if (_e464) {
                                } else {
                                    v36_2 = true;
                                    break;
                                }
                                uint _e466 = lightbvh_trails.list[_e463];
                                v28_2 = _e466;
                            }
                            uint _e468 = v28_2;
                            v29_2 = (_e438 + 1u);
                            v30_2 = LightbvhType23_((((_e440.member << 3u) | ((_e442 & 7u) & 7u)) & 1073741823u), (((_e440.member_1 << 3u) | ((_e440.member >> 27u) & 7u)) & 1073741823u));
                            v31_2 = _e468;
                        }
                        uint _e471 = v29_2;
                        LightbvhType23_ _e473 = v30_2;
                        uint _e475 = v31_2;
                        v32_2 = _e471;
                        v33_2 = _e473;
                        v34_2 = _e475;
                        v35_2 = _e444;
                    }
                    uint _e477 = v32_2;
                    LightbvhType23_ _e479 = v33_2;
                    uint _e481 = v34_2;
                    bool _e483 = v35_2;
                    continue;
                }
                bool _e486 = v36_2;
                if (_e486) {
                    break;
                }
                LightbvhType23_ _e489 = v37_2;
                v18_2 = _e486;
                v19_2 = LightbvhType24_(_e489, LightbvhType23_(_e392, _e405));
            }
            bool _e407 = v18_2;
            LightbvhType24_ _e409 = v19_2;
            v38_2 = _e407;
            v39_2 = _e409;
            if (_e370) {
            } else {
                v38_2 = false;
                v39_2 = LightbvhType24_(LightbvhType23_(_e392, _e405), LightbvhType23_(0u, 0u));
            }
            bool _e492 = v38_2;
            LightbvhType24_ _e494 = v39_2;
            v40_2 = _e492;
            v41_2 = _e494;
            v42_2 = _e369;
            v43_2 = _e367;
        }
        bool _e496 = v40_2;
        LightbvhType24_ _e498 = v41_2;
        uint _e500 = v42_2;
        uint _e502 = v43_2;
        bool _e505 = (_e181 == 0u);
        LightbvhType31_ _e507 = LightbvhType31_(_e498, LightbvhType23_(_e183.member_1[0], _e183.member_1[1]), LightbvhType25_(0.0, 1.0), 0u, (_e160 + _e157), 4294967295u, 4294967295u, 0u, 4194304u, 0u, _e183.member, _e181, _e505, (_e502 != 4294967295u));
        uint _e510 = (uint(21) - uint(findMSB(4128767u)));
        uint _e512 = ((_e510 < 22u) ? _e510 : 22u);
        uint _e520 = (_e512 & 31u);
        LightbvhType31_ _e541 = LightbvhType31_(_e507.member, LightbvhType23_((((_e183.member_1[0] - 67108864u) << _e520) | ((_e183.member_1[1] >> uint(1)) >> ((31u - _e512) & 31u))), (_e183.member_1[1] << _e520)), _e507.member_2, _e507.member_3, _e507.member_4, _e507.member_5, _e507.member_6, _e507.member_7, _e507.member_8, _e507.member_9, _e507.member_10, _e507.member_11, _e507.member_12, _e507.member_13);
        LightbvhType31_ _e558 = LightbvhType31_(_e541.member, _e541.member_1, _e541.member_2, _e541.member_3, _e541.member_4, _e541.member_5, _e541.member_6, _e541.member_7, (4128768u << _e520), _e541.member_9, _e541.member_10, _e541.member_11, _e541.member_12, _e541.member_13);
        v44_2 = _e496;
        v45_2 = LightbvhType32_(_e502, _e500, LightbvhType31_(_e558.member, _e558.member_1, _e558.member_2, _e558.member_3, _e558.member_4, _e558.member_5, _e558.member_6, _e558.member_7, _e558.member_8, _e512, _e558.member_10, _e558.member_11, _e558.member_12, _e558.member_13));
        v46_2 = _e505;
        bool loop_init_7 = true;
        while(true) {
            if (!loop_init_7) {
                v44_2 = v69_2;
                v45_2 = v70_2;
                v46_2 = v71_2;
                v72_2 = v69_2;
                if (!((v46_2 ? false : true))) {
                    break;
                }
            }
            loop_init_7 = false;
            bool _e576 = v44_2;
            LightbvhType32_ _e578 = v45_2;
            bool _e580 = v46_2;
            v73_2 = _e578;
            v74_2 = _e578;
            v75_2 = _e578;
            v76_2 = _e578;
            v79_2 = _e578;
            v80_2 = _e578;
            v69_2 = _e576;
            v70_2 = LightbvhType32_(0u, 0u, LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false));
            v71_2 = false;
            if (_e580) {
            } else {
                bool _e583 = (_e578.member_2.member_4 < _e148);
                uint _e584 = (_e583 ? _e578.member_2.member_4 : 0u);
                if ((_e584 < _e148)) {
                } else {
                    v72_2 = true;
                    break;
                }
                uint _e625 = lightbvh_nodes.list[_e584][0u][3u];
                int _e628 = (int((_e625 & 255u)) - 127);
                float _e638 = uintBitsToFloat((floatBitsToUint(_e578.member_2.member_10.member_1[0]) & 2147483647u));
                float _e641 = uintBitsToFloat((floatBitsToUint(_e578.member_2.member_10.member_1[1]) & 2147483647u));
                float _e644 = uintBitsToFloat((floatBitsToUint(_e578.member_2.member_10.member_1[2]) & 2147483647u));
                float _e646 = ((_e638 > _e641) ? _e638 : _e641);
                int _e654 = (int(((floatBitsToUint(((_e646 > _e644) ? _e646 : _e644)) >> uint(23)) & 255u)) - 127);
                int _e656 = ((_e654 > _e628) ? _e654 : _e628);
                float _e662 = (1.0 - (((_e578.member_2.member_10.member_2[0] * _e578.member_2.member_10.member_2[0]) + (_e578.member_2.member_10.member_2[1] * _e578.member_2.member_10.member_2[1])) + (_e578.member_2.member_10.member_2[2] * _e578.member_2.member_10.member_2[2])));
                float _e664 = ((_e662 > 3.8146973e-6) ? _e662 : 3.8146973e-6);
                float _e669 = uintBitsToFloat((1595932665u - (floatBitsToUint(_e664) >> uint(1))));
                float _e676 = (0.5 * (_e664 * (_e669 * (0.70395225 * (2.3892446 - (_e664 * (_e669 * _e669)))))));
                float _e678 = (0.0001 + _e676);
                uint _e682 = lightbvh_nodes.list[_e584][0u][0u];
                uint _e687 = lightbvh_nodes.list[_e584][0u][1u];
                uint _e692 = lightbvh_nodes.list[_e584][0u][2u];
                float _e694 = (uintBitsToFloat(_e682) - _e578.member_2.member_10.member[0]);
                float _e695 = (uintBitsToFloat(_e687) - _e578.member_2.member_10.member[1]);
                float _e696 = (uintBitsToFloat(_e692) - _e578.member_2.member_10.member[2]);
                float _e699 = uintBitsToFloat((floatBitsToUint(_e694) & 2147483647u));
                float _e702 = uintBitsToFloat((floatBitsToUint(_e695) & 2147483647u));
                float _e705 = uintBitsToFloat((floatBitsToUint(_e696) & 2147483647u));
                float _e707 = ((_e699 > _e702) ? _e699 : _e702);
                int _e715 = (int(((floatBitsToUint(((_e707 > _e705) ? _e707 : _e705)) >> uint(23)) & 255u)) - 127);
                int _e717 = ((_e715 > _e656) ? _e715 : _e656);
                int _e718 = (_e628 - _e717);
                int _e720 = ((_e718 < -40) ? -40 : _e718);
                int _e721 = -(_e717);
                int _e723 = ((_e721 < -126) ? -126 : _e721);
                float _e730 = uintBitsToFloat((uint((((_e723 > 127) ? 127 : _e723) + 127)) << uint(23)));
                int _e735 = ((_e720 < -126) ? -126 : _e720);
                float _e742 = uintBitsToFloat((uint((((_e735 > 127) ? 127 : _e735) + 127)) << uint(23)));
                float _e743 = (_e578.member_2.member_10.member_1[0] * _e730);
                float _e744 = (_e578.member_2.member_10.member_1[1] * _e730);
                float _e745 = (_e578.member_2.member_10.member_1[2] * _e730);
                float _e748 = uintBitsToFloat((floatBitsToUint(_e578.member_2.member_10.member_2[0]) & 2147483647u));
                float _e751 = uintBitsToFloat((floatBitsToUint(_e578.member_2.member_10.member_2[1]) & 2147483647u));
                float _e754 = uintBitsToFloat((floatBitsToUint(_e578.member_2.member_10.member_2[2]) & 2147483647u));
                float _e759 = (((_e743 * _e748) + (_e744 * _e751)) + (_e745 * _e754));
                float _e766 = ((0.22222222 * (((_e743 * _e743) + (_e744 * _e744)) + (_e745 * _e745))) + 8.881784e-16);
                float _e768 = (_e742 * 4.656613e-10);
                float _e771 = (2.0 * 8.0);
                float _e772 = (_e748 * _e771);
                float _e773 = (_e751 * _e771);
                float _e774 = (_e754 * _e771);
                v0_2 = float[8](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
                v47_2 = LightbvhType23_(0u, 8u);
                bool loop_init_8 = true;
                while(true) {
                    if (!loop_init_8) {
                        v47_2 = v50_2;
                        v52_2 = _e576;
                        if (!((int(v51_2.member) != 0))) {
                            break;
                        }
                    }
                    loop_init_8 = false;
                    LightbvhType23_ _e781 = v47_2;
                    bool _e784 = (_e781.member < _e781.member_1);
                    v48_2 = LightbvhType23_(0u, 0u);
                    v49_2 = LightbvhType23_(0u, 0u);
                    if (_e784) {
                        v48_2 = LightbvhType23_((_e781.member + 1u), _e781.member_1);
                        v49_2 = LightbvhType23_(1u, _e781.member);
                    }
                    LightbvhType23_ _e786 = v48_2;
                    LightbvhType23_ _e788 = v49_2;
                    v50_2 = _e786;
                    v51_2 = _e788;
                    if (_e784) {
                    } else {
                        v50_2 = _e781;
                        v51_2 = LightbvhType23_(0u, LightbvhType23_(0u, 0u).member_1);
                    }
                    LightbvhType23_ _e798 = v50_2;
                    LightbvhType23_ _e800 = v51_2;
                    bool _e804 = (int(_e800.member) != 0);
                    if (_e804) {
                        bool _e805 = (_e800.member_1 < 8u);
                        if (_e805) {
                        } else {
                            v52_2 = true;
                            break;
                        }
                        uint _e809 = lightbvh_nodes.list[_e584][1u][_e800.member_1];
                        if (_e805) {
                        } else {
                            v52_2 = true;
                            break;
                        }
                        uint _e813 = lightbvh_nodes.list[_e584][2u][_e800.member_1];
                        if (_e805) {
                        } else {
                            v52_2 = true;
                            break;
                        }
                        uint _e817 = lightbvh_nodes.list[_e584][3u][_e800.member_1];
                        if (_e805) {
                        } else {
                            v52_2 = true;
                            break;
                        }
                        uint _e821 = lightbvh_nodes.list[_e584][4u][_e800.member_1];
                        float _e837 = ((_e694 * _e730) + (float(int(_e809)) * _e768));
                        float _e838 = ((_e695 * _e730) + (float(int((_e809 << 15u))) * _e768));
                        float _e839 = ((_e696 * _e730) + (float(int(_e813)) * _e768));
                        float _e844 = uintBitsToFloat((((_e821 << 20u) & 267386880u) + (floatBitsToUint(_e742) + 4043309056u)));
                        float _e851 = float(int(_e817));
                        float _e855 = float(int((_e817 << 8u)));
                        float _e859 = float(int((_e817 << 16u)));
                        float _e863 = (float(int((_e817 & 255u))) * 0.003921569);
                        float _e880 = (_e844 * _e844);
                        float _e881 = (1.0 + (float(int((_e813 << 15u))) * 4.656613e-10));
                        float _e882 = (_e880 + _e766);
                        float _e885 = ((_e880 * (_e881 * _e881)) + _e766);
                        float _e890 = uintBitsToFloat((1595932665u - (floatBitsToUint(_e882) >> uint(1))));
                        float _e895 = (_e890 * (0.70395225 * (2.3892446 - (_e882 * (_e890 * _e890)))));
                        float _e896 = (_e882 * _e895);
                        float _e901 = uintBitsToFloat((1595932665u - (floatBitsToUint(_e885) >> uint(1))));
                        float _e909 = (((_e885 * (_e901 * (0.70395225 * (2.3892446 - (_e885 * (_e901 * _e901)))))) * _e895) - 1.0);
                        float _e922 = (uintBitsToFloat((floatBitsToUint(_e837) & 2147483647u)) - _e743);
                        float _e923 = (uintBitsToFloat((floatBitsToUint(_e838) & 2147483647u)) - _e744);
                        float _e924 = (uintBitsToFloat((floatBitsToUint(_e839) & 2147483647u)) - _e745);
                        float _e926 = ((_e922 > 0.0) ? _e922 : 0.0);
                        float _e928 = ((_e923 > 0.0) ? _e923 : 0.0);
                        float _e930 = ((_e924 > 0.0) ? _e924 : 0.0);
                        float _e931 = (_e896 * _e896);
                        float _e937 = ((((_e837 * _e837) + (_e838 * _e838)) + (_e839 * _e839)) + 8.881784e-16);
                        float _e947 = (_e937 + (1.25 * _e931));
                        float _e952 = uintBitsToFloat((1595932665u - (floatBitsToUint(_e947) >> uint(1))));
                        float _e957 = (_e952 * (0.70395225 * (2.3892446 - (_e947 * (_e952 * _e952)))));
                        float _e958 = (_e896 * _e957);
                        float _e963 = ((((_e578.member_2.member_10.member_2[0] * 4.656613e-10) * _e851) + ((_e578.member_2.member_10.member_2[1] * 4.656613e-10) * _e855)) + ((_e578.member_2.member_10.member_2[2] * 4.656613e-10) * _e859));
                        float _e968 = ((0.03162278 + _e676) + (_e958 * (1.0 + (_e909 * (_e963 * _e963)))));
                        float _e974 = (((((_e578.member_2.member_10.member_2[0] + _e578.member_2.member_10.member_2[0]) * _e837) + ((_e578.member_2.member_10.member_2[1] + _e578.member_2.member_10.member_2[1]) * _e838)) + ((_e578.member_2.member_10.member_2[2] + _e578.member_2.member_10.member_2[2]) * _e839)) * _e957);
                        float _e976 = (_e974 + (((((((_e772 + _e773) + _e774) + ((((_e772 * 4.656613e-10) * float(int(_e821))) + ((_e773 * 4.656613e-10) * float(int((_e821 << 8u))))) + ((_e774 * 4.656613e-10) * float(int((_e821 << 16u)))))) * _e844) + (_e759 + _e759)) * _e895) * _e958));
                        float _e978 = ((_e976 > _e678) ? _e976 : _e678);
                        float _e984 = (uintBitsToFloat((floatBitsToUint(_e974) & 2147483647u)) + _e968);
                        float _e990 = (1.0 + _e909);
                        float _e996 = ((((_e851 * _e837) + (_e855 * _e838)) + (_e859 * _e839)) * (-2.0 * 4.656613e-10));
                        float _e999 = (_e896 * ((_e990 > _e863) ? _e990 : _e863));
                        float _e1001 = (_e937 - (2.5 * _e931));
                        float _e1003 = (0.25 * (_e996 * _e996));
                        float _e1009 = ((((_e1001 > _e1003) ? _e1001 : _e1003) + 8.881784e-16) + (1.25 * (_e999 * _e999)));
                        float _e1014 = uintBitsToFloat((1595932665u - (floatBitsToUint(_e1009) >> uint(1))));
                        float _e1019 = (_e1014 * (0.70395225 * (2.3892446 - (_e1009 * (_e1014 * _e1014)))));
                        float _e1021 = ((_e896 * _e1019) * _e990);
                        float _e1025 = ((0.03162278 + _e1021) + (_e863 * (0.5 - _e1021)));
                        float _e1026 = (_e996 * _e1019);
                        float _e1030 = (uintBitsToFloat((floatBitsToUint(_e1026) & 2147483647u)) + _e1025);
                        float _e1039 = ((_e984 * _e1030) * (((((_e926 * _e926) + (_e928 * _e928)) + (_e930 * _e930)) + 8.881784e-16) + (0.5 * _e931)));
                        float _e1042 = uintBitsToFloat((2129859015u - floatBitsToUint(_e1039)));
                        if (_e805) {
                        } else {
                            v52_2 = true;
                            break;
                        }
                        v0_2[_e800.member_1] = ((uintBitsToFloat(((_e813 & 2047u) << 19u)) * (((((_e974 > 0.0) ? _e974 : 0.0) * _e984) + (_e968 * ((_e978 < _e968) ? _e978 : _e968))) * ((((_e1026 > 0.0) ? _e1026 : 0.0) * _e1030) + (_e1025 * _e1025)))) * (_e1042 * (2.0 - (_e1039 * _e1042))));
                    }
                    continue;
                }
                bool _e1050 = v52_2;
                v72_2 = _e1050;
                if (_e1050) {
                    break;
                }
                float _e1051[8] = v0_2;
                bool _e1073 = (_e578.member_2.member_7 < 20u);
                v53_2 = 0u;
                if (_e1073) {
                    bool _e1096 = (_e578.member_2.member_7 < 10u);
                    v55_2 = _e578.member_2.member_7;
                    if (_e1096) {
                    } else {
                        v55_2 = (_e578.member_2.member_7 - 10u);
                    }
                    uint _e1099 = v55_2;
                    v53_2 = (((_e1096 ? _e578.member_2.member.member.member : _e578.member_2.member.member.member_1) >> (((_e1099 * 3u) & 31u) & 31u)) & 7u);
                }
                uint _e1075 = v53_2;
                v56_2 = _e1075;
                if (_e1073) {
                } else {
                    uint _e1080 = (_e578.member_2.member_7 - 20u);
                    bool _e1081 = (_e1080 < 10u);
                    v54_2 = _e1080;
                    if (_e1081) {
                    } else {
                        v54_2 = (_e578.member_2.member_7 - 30u);
                    }
                    uint _e1084 = v54_2;
                    v56_2 = (((_e1081 ? _e578.member_2.member.member_1.member : _e578.member_2.member.member_1.member_1) >> (((_e1084 * 3u) & 31u) & 31u)) & 7u);
                }
                uint _e1108 = v56_2;
                uint _e1113 = (0u - ((_e1051[1] > 0.0) ? 1u : 0u));
                uint _e1114 = (1u & _e1113);
                uint _e1118 = (0u - ((_e1051[2] > 0.0) ? 1u : 0u));
                uint _e1121 = (_e1114 ^ ((2u ^ _e1114) & _e1118));
                uint _e1125 = (0u - ((_e1051[3] > 0.0) ? 1u : 0u));
                uint _e1128 = (_e1121 ^ ((3u ^ _e1121) & _e1125));
                uint _e1132 = (0u - ((_e1051[4] > 0.0) ? 1u : 0u));
                uint _e1135 = (_e1128 ^ ((4u ^ _e1128) & _e1132));
                uint _e1139 = (0u - ((_e1051[5] > 0.0) ? 1u : 0u));
                uint _e1142 = (_e1135 ^ ((5u ^ _e1135) & _e1139));
                uint _e1146 = (0u - ((_e1051[6] > 0.0) ? 1u : 0u));
                uint _e1149 = (_e1142 ^ ((6u ^ _e1142) & _e1146));
                uint _e1153 = (0u - ((_e1051[7] > 0.0) ? 1u : 0u));
                uint _e1156 = (_e1149 ^ ((7u ^ _e1149) & _e1153));
                float _e1159 = ((((0.0 + _e1051[0]) + _e1051[4]) + ((0.0 + _e1051[2]) + _e1051[6])) + (((0.0 + _e1051[1]) + _e1051[5]) + ((0.0 + _e1051[3]) + _e1051[7])));
                bool _e1160 = (_e1159 > 0.0);
                float _e1164 = (_e1160 ? _e1159 : 1.0);
                uint _e1165 = floatBitsToUint(_e1164);
                float _e1170 = uintBitsToFloat(((_e1165 & 2147483648u) | (2129859015u - (_e1165 & 2147483647u))));
                float _e1173 = (_e1170 * (2.0 - (_e1164 * _e1170)));
                float _e1177 = ((float(int(_e578.member_2.member_8)) * 0.9999695) * (_e1173 * (2.0 - (_e1164 * _e1173))));
                v57_2 = 2147483647;
                if (_e578.member_2.member_13) {
                } else {
                    v57_2 = int((_e578.member_2.member_1.member >> 10u));
                }
                int _e1180 = v57_2;
                int _e1186 = int((floatBitsToUint(((_e1051[0] * _e1177) + 8388608.0)) & 8388607u));
                int _e1193 = (((_e1186 > 1) ? _e1186 : 1) & int((0u - ((_e1051[0] > 0.0) ? 1u : 0u))));
                uint _e1194 = uint(_e1193);
                uint _e1195 = (_e1194 & 4294967295u);
                int _e1197 = int((_e578.member_2.member_13 ? _e1108 : _e1156));
                uint _e1201 = (0u - (((_e1193 <= _e1180) && (0 < _e1197)) ? 1u : 0u));
                uint _e1202 = (_e1194 & _e1201);
                int _e1208 = int((floatBitsToUint(((_e1051[1] * _e1177) + 8388608.0)) & 8388607u));
                int _e1213 = (_e1193 + (((_e1208 > 1) ? _e1208 : 1) & int(_e1113)));
                uint _e1214 = uint(_e1213);
                uint _e1217 = (_e1195 ^ ((_e1214 ^ _e1195) & _e1201));
                uint _e1222 = (0u - (((_e1213 <= _e1180) && (1 < _e1197)) ? 1u : 0u));
                uint _e1225 = (_e1202 ^ ((_e1214 ^ _e1202) & _e1222));
                int _e1232 = int((floatBitsToUint(((_e1051[2] * _e1177) + 8388608.0)) & 8388607u));
                int _e1237 = (_e1213 + (((_e1232 > 1) ? _e1232 : 1) & int(_e1118)));
                uint _e1238 = uint(_e1237);
                uint _e1241 = (_e1217 ^ ((_e1238 ^ _e1217) & _e1222));
                uint _e1246 = (0u - (((_e1237 <= _e1180) && (2 < _e1197)) ? 1u : 0u));
                uint _e1249 = (_e1225 ^ ((_e1238 ^ _e1225) & _e1246));
                int _e1256 = int((floatBitsToUint(((_e1051[3] * _e1177) + 8388608.0)) & 8388607u));
                int _e1261 = (_e1237 + (((_e1256 > 1) ? _e1256 : 1) & int(_e1125)));
                uint _e1262 = uint(_e1261);
                uint _e1265 = (_e1241 ^ ((_e1262 ^ _e1241) & _e1246));
                uint _e1270 = (0u - (((_e1261 <= _e1180) && (3 < _e1197)) ? 1u : 0u));
                uint _e1273 = (_e1249 ^ ((_e1262 ^ _e1249) & _e1270));
                int _e1280 = int((floatBitsToUint(((_e1051[4] * _e1177) + 8388608.0)) & 8388607u));
                int _e1285 = (_e1261 + (((_e1280 > 1) ? _e1280 : 1) & int(_e1132)));
                uint _e1286 = uint(_e1285);
                uint _e1289 = (_e1265 ^ ((_e1286 ^ _e1265) & _e1270));
                uint _e1294 = (0u - (((_e1285 <= _e1180) && (4 < _e1197)) ? 1u : 0u));
                uint _e1297 = (_e1273 ^ ((_e1286 ^ _e1273) & _e1294));
                int _e1304 = int((floatBitsToUint(((_e1051[5] * _e1177) + 8388608.0)) & 8388607u));
                int _e1309 = (_e1285 + (((_e1304 > 1) ? _e1304 : 1) & int(_e1139)));
                uint _e1310 = uint(_e1309);
                uint _e1313 = (_e1289 ^ ((_e1310 ^ _e1289) & _e1294));
                uint _e1318 = (0u - (((_e1309 <= _e1180) && (5 < _e1197)) ? 1u : 0u));
                uint _e1321 = (_e1297 ^ ((_e1310 ^ _e1297) & _e1318));
                int _e1328 = int((floatBitsToUint(((_e1051[6] * _e1177) + 8388608.0)) & 8388607u));
                int _e1333 = (_e1309 + (((_e1328 > 1) ? _e1328 : 1) & int(_e1146)));
                uint _e1334 = uint(_e1333);
                uint _e1337 = (_e1313 ^ ((_e1334 ^ _e1313) & _e1318));
                uint _e1342 = (0u - (((_e1333 <= _e1180) && (6 < _e1197)) ? 1u : 0u));
                uint _e1345 = (_e1321 ^ ((_e1334 ^ _e1321) & _e1342));
                int _e1352 = int((floatBitsToUint(((_e1051[7] * _e1177) + 8388608.0)) & 8388607u));
                int _e1357 = (_e1333 + (((_e1352 > 1) ? _e1352 : 1) & int(_e1153)));
                uint _e1358 = uint(_e1357);
                uint _e1361 = (_e1337 ^ ((_e1358 ^ _e1337) & _e1342));
                uint _e1366 = (0u - (((_e1357 <= _e1180) && (7 < _e1197)) ? 1u : 0u));
                uint _e1369 = (_e1345 ^ ((_e1358 ^ _e1345) & _e1366));
                uint _e1372 = (_e578.member_2.member_13 ? _e1108 : ((((((((_e1201 & 1u) + (_e1222 & 1u)) + (_e1246 & 1u)) + (_e1270 & 1u)) + (_e1294 & 1u)) + (_e1318 & 1u)) + (_e1342 & 1u)) + (_e1366 & 1u)));
                bool _e1377 = (_e1372 < 8u);
                bool _e1378 = ((_e1160 && (_e1361 > _e1369)) && _e1377);
                uint _e1379 = (_e1377 ? _e1372 : 0u);
                v58_2 = 0u;
                if (_e1378) {
                    v58_2 = (((_e1372 == _e1156) ? _e578.member_2.member_8 : _e1361) - _e1369);
                }
                uint _e1383 = v58_2;
                bool _e1384 = (_e1379 < 8u);
                if (_e1384) {
                } else {
                    v72_2 = true;
                    break;
                }
                uint _e1388 = lightbvh_nodes.list[_e584][1u][_e1379];
                uint _e1389 = (_e1388 & 3u);
                if (_e1384) {
                } else {
                    v72_2 = true;
                    break;
                }
                uint _e1393 = lightbvh_nodes.list[_e584][5u][_e1379];
                bool _e1397 = ((_e583 && (_e1383 > 0u)) && (_e1383 <= _e578.member_2.member_8));
                uint _e1398 = (_e1397 ? _e1383 : 1u);
                uint _e1400 = ((_e1398 - 1u) & 4194303u);
                uint _e1406 = (((_e1400 == 0u) ? 32u : (uint(31) - uint(findMSB(_e1400)))) - 10u);
                uint _e1408 = ((_e1406 < 22u) ? _e1406 : 22u);
                uint _e1421 = (_e1408 & 31u);
                LightbvhType32_ _e1446 = LightbvhType32_(_e578.member, _e578.member_1, LightbvhType31_(_e578.member_2.member, LightbvhType23_((((_e578.member_2.member_1.member - ((_e1378 ? _e1369 : 0u) << 10u)) << _e1421) | ((_e578.member_2.member_1.member_1 >> uint(1)) >> ((31u - _e1408) & 31u))), (_e578.member_2.member_1.member_1 << _e1421)), _e578.member_2.member_2, _e578.member_2.member_3, _e578.member_2.member_4, _e578.member_2.member_5, _e578.member_2.member_6, _e578.member_2.member_7, _e578.member_2.member_8, _e578.member_2.member_9, _e578.member_2.member_10, _e578.member_2.member_11, _e578.member_2.member_12, _e578.member_2.member_13));
                LightbvhType32_ _e1467 = LightbvhType32_(_e1446.member, _e1446.member_1, LightbvhType31_(_e1446.member_2.member, _e1446.member_2.member_1, _e1446.member_2.member_2, _e1446.member_2.member_3, _e1446.member_2.member_4, _e1446.member_2.member_5, _e1446.member_2.member_6, _e1446.member_2.member_7, (_e1398 << _e1421), _e1446.member_2.member_9, _e1446.member_2.member_10, _e1446.member_2.member_11, _e1446.member_2.member_12, _e1446.member_2.member_13));
                LightbvhType32_ _e1489 = LightbvhType32_(_e1467.member, _e1467.member_1, LightbvhType31_(_e1467.member_2.member, _e1467.member_2.member_1, _e1467.member_2.member_2, _e1467.member_2.member_3, _e1467.member_2.member_4, _e1467.member_2.member_5, _e1467.member_2.member_6, _e1467.member_2.member_7, _e1467.member_2.member_8, (_e578.member_2.member_9 + _e1408), _e1467.member_2.member_10, _e1467.member_2.member_11, _e1467.member_2.member_12, _e1467.member_2.member_13));
                uint _e1490 = (_e578.member_2.member_7 + 1u);
                v59_2 = true;
                if ((_e1490 == 20u)) {
                } else {
                    v59_2 = (_e1490 == 40u);
                }
                bool _e1494 = v59_2;
                uint _e1495 = (_e1393 & 134217727u);
                uint _e1499 = (_e1393 >> (uint(findLSB(134217728u)) & 31u));
                bool _e1503 = (_e1495 < _e151);
                bool _e1504 = (((_e1397 && (_e1389 == 3u)) && _e1073) && _e1503);
                bool _e1508 = ((_e1397 && (_e1389 == 1u)) && !(_e1494));
                LightbvhType32_ _e1530 = LightbvhType32_(_e1489.member, _e1489.member_1, LightbvhType31_(_e1489.member_2.member, _e1489.member_2.member_1, _e1489.member_2.member_2, _e1489.member_2.member_3, _e1489.member_2.member_4, ((_e1397 && (_e1389 == 2u)) ? _e1393 : 4294967295u), _e1489.member_2.member_6, _e1489.member_2.member_7, _e1489.member_2.member_8, _e1489.member_2.member_9, _e1489.member_2.member_10, _e1489.member_2.member_11, _e1489.member_2.member_12, _e1489.member_2.member_13));
                uint _e1533 = (_e578.member_2.member_11 - 1u);
                LightbvhType32_ _e1552 = LightbvhType32_(_e1530.member, _e1530.member_1, LightbvhType31_(_e1530.member_2.member, _e1530.member_2.member_1, _e1530.member_2.member_2, _e1530.member_2.member_3, _e1530.member_2.member_4, _e1530.member_2.member_5, _e1530.member_2.member_6, _e1530.member_2.member_7, _e1530.member_2.member_8, _e1530.member_2.member_9, _e1530.member_2.member_10, _e1533, _e1530.member_2.member_12, _e1530.member_2.member_13));
                bool _e1556 = (!((_e1504 || _e1508)) || (_e1533 == 0u));
                LightbvhType32_ _e1575 = LightbvhType32_(_e1552.member, _e1552.member_1, LightbvhType31_(_e1552.member_2.member, _e1552.member_2.member_1, _e1552.member_2.member_2, _e1552.member_2.member_3, _e1552.member_2.member_4, _e1552.member_2.member_5, _e1552.member_2.member_6, _e1552.member_2.member_7, _e1552.member_2.member_8, _e1552.member_2.member_9, _e1552.member_2.member_10, _e1552.member_2.member_11, _e1556, _e1552.member_2.member_13));
                v60_2 = LightbvhType32_(0u, 0u, LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false));
                if (_e1504) {
                    if (_e1503) {
                    } else {
                        v72_2 = true;
                        break;
                    }
                    LightbvhType32_ _e1640 = LightbvhType32_(_e1575.member, _e1575.member_1, LightbvhType31_(_e1575.member_2.member, _e1575.member_2.member_1, _e1575.member_2.member_2, _e1575.member_2.member_3, _e1575.member_2.member_4, _e1575.member_2.member_5, _e1495, _e1575.member_2.member_7, _e1575.member_2.member_8, _e1575.member_2.member_9, _e1575.member_2.member_10, _e1575.member_2.member_11, _e1575.member_2.member_12, _e1575.member_2.member_13));
                    uint _e1643 = lightbvh_instances.list[_e1495].root;
                    LightbvhType32_ _e1662 = LightbvhType32_(_e1640.member, _e1640.member_1, LightbvhType31_(_e1640.member_2.member, _e1640.member_2.member_1, _e1640.member_2.member_2, _e1640.member_2.member_3, _e1643, _e1640.member_2.member_5, _e1640.member_2.member_6, _e1640.member_2.member_7, _e1640.member_2.member_8, _e1640.member_2.member_9, _e1640.member_2.member_10, _e1640.member_2.member_11, _e1640.member_2.member_12, _e1640.member_2.member_13));
                    bool _e1663 = (_e1643 == 4294967295u);
                    v62_2 = 4294967295u;
                    if (_e1663) {
                        uint _e1666 = lightbvh_instances.list[_e1495].first_light;
                        v62_2 = _e1666;
                    }
                    uint _e1668 = v62_2;
                    LightbvhType32_ _e1687 = LightbvhType32_(_e1662.member, _e1662.member_1, LightbvhType31_(_e1662.member_2.member, _e1662.member_2.member_1, _e1662.member_2.member_2, _e1662.member_2.member_3, _e1662.member_2.member_4, _e1668, _e1662.member_2.member_6, _e1662.member_2.member_7, _e1662.member_2.member_8, _e1662.member_2.member_9, _e1662.member_2.member_10, _e1662.member_2.member_11, _e1662.member_2.member_12, _e1662.member_2.member_13));
                    bool _e1688 = (_e1556 || _e1663);
                    LightbvhType32_ _e1707 = LightbvhType32_(_e1687.member, _e1687.member_1, LightbvhType31_(_e1687.member_2.member, _e1687.member_2.member_1, _e1687.member_2.member_2, _e1687.member_2.member_3, _e1687.member_2.member_4, _e1687.member_2.member_5, _e1687.member_2.member_6, _e1687.member_2.member_7, _e1687.member_2.member_8, _e1687.member_2.member_9, _e1687.member_2.member_10, _e1687.member_2.member_11, _e1688, _e1687.member_2.member_13));
                    LightbvhType32_ _e1726 = LightbvhType32_(_e1707.member, _e1707.member_1, LightbvhType31_(_e1707.member_2.member, _e1707.member_2.member_1, _e1707.member_2.member_2, _e1707.member_2.member_3, _e1707.member_2.member_4, _e1707.member_2.member_5, _e1707.member_2.member_6, 20u, _e1707.member_2.member_8, _e1707.member_2.member_9, _e1707.member_2.member_10, _e1707.member_2.member_11, _e1707.member_2.member_12, _e1707.member_2.member_13));
                    v63_2 = _e1726;
                    if ((_e1499 > 0u)) {
                        uint _e1729 = ((_e1643 < _e148) ? _e1643 : 0u);
                        if ((_e1729 < _e148)) {
                        } else {
                            v72_2 = true;
                            break;
                        }
                        uint _e1732 = ((_e1499 - 1u) % 8u);
                        bool _e1733 = (_e1732 < 8u);
                        if (_e1733) {
                        } else {
                            v72_2 = true;
                            break;
                        }
                        uint _e1737 = lightbvh_nodes.list[_e1729][1u][_e1732];
                        uint _e1738 = (_e1737 & 3u);
                        if (_e1733) {
                        } else {
                            v72_2 = true;
                            break;
                        }
                        uint _e1742 = lightbvh_nodes.list[_e1729][5u][_e1732];
                        LightbvhType32_ _e1761 = LightbvhType32_(_e1726.member, _e1726.member_1, LightbvhType31_(_e1726.member_2.member, _e1726.member_2.member_1, _e1726.member_2.member_2, _e1726.member_2.member_3, _e1742, _e1726.member_2.member_5, _e1726.member_2.member_6, _e1726.member_2.member_7, _e1726.member_2.member_8, _e1726.member_2.member_9, _e1726.member_2.member_10, _e1726.member_2.member_11, _e1726.member_2.member_12, _e1726.member_2.member_13));
                        LightbvhType32_ _e1782 = LightbvhType32_(_e1761.member, _e1761.member_1, LightbvhType31_(_e1761.member_2.member, _e1761.member_2.member_1, _e1761.member_2.member_2, _e1761.member_2.member_3, _e1761.member_2.member_4, ((_e1738 == 2u) ? _e1742 : 4294967295u), _e1761.member_2.member_6, _e1761.member_2.member_7, _e1761.member_2.member_8, _e1761.member_2.member_9, _e1761.member_2.member_10, _e1761.member_2.member_11, _e1761.member_2.member_12, _e1761.member_2.member_13));
                        LightbvhType32_ _e1803 = LightbvhType32_(_e1782.member, _e1782.member_1, LightbvhType31_(_e1782.member_2.member, _e1782.member_2.member_1, _e1782.member_2.member_2, _e1782.member_2.member_3, _e1782.member_2.member_4, _e1782.member_2.member_5, _e1782.member_2.member_6, _e1782.member_2.member_7, _e1782.member_2.member_8, _e1782.member_2.member_9, _e1782.member_2.member_10, _e1782.member_2.member_11, (_e1688 || (_e1738 != 1u)), _e1782.member_2.member_13));
                        v63_2 = LightbvhType32_(_e1803.member, _e1803.member_1, LightbvhType31_(_e1803.member_2.member, _e1803.member_2.member_1, _e1803.member_2.member_2, _e1803.member_2.member_3, _e1803.member_2.member_4, _e1803.member_2.member_5, _e1803.member_2.member_6, 21u, _e1803.member_2.member_8, _e1803.member_2.member_9, _e1803.member_2.member_10, _e1803.member_2.member_11, _e1803.member_2.member_12, _e1803.member_2.member_13));
                    }
                    LightbvhType32_ _e1824 = v63_2;
                    float _e1833 = lightbvh_instances.list[_e1495].translation[0u];
                    float _e1837 = lightbvh_instances.list[_e1495].translation[1u];
                    float _e1841 = lightbvh_instances.list[_e1495].translation[2u];
                    float _e1842 = (_e183.member.member[0] - _e1833);
                    float _e1843 = (_e183.member.member[1] - _e1837);
                    float _e1844 = (_e183.member.member[2] - _e1841);
                    float _e1849 = ((uintBitsToFloat((floatBitsToUint(_e1842) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1842);
                    float _e1854 = ((uintBitsToFloat((floatBitsToUint(_e1843) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1843);
                    float _e1859 = ((uintBitsToFloat((floatBitsToUint(_e1844) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1844);
                    float _e1864 = lightbvh_instances.list[_e1495].inverse_[0u][0u];
                    float _e1869 = lightbvh_instances.list[_e1495].inverse_[0u][1u];
                    float _e1874 = lightbvh_instances.list[_e1495].inverse_[0u][2u];
                    float _e1882 = lightbvh_instances.list[_e1495].inverse_[1u][0u];
                    float _e1887 = lightbvh_instances.list[_e1495].inverse_[1u][1u];
                    float _e1892 = lightbvh_instances.list[_e1495].inverse_[1u][2u];
                    float _e1903 = lightbvh_instances.list[_e1495].inverse_[2u][0u];
                    float _e1908 = lightbvh_instances.list[_e1495].inverse_[2u][1u];
                    float _e1913 = lightbvh_instances.list[_e1495].inverse_[2u][2u];
                    float _e1917 = (((_e1864 * _e1849) + (_e1882 * _e1854)) + (_e1903 * _e1859));
                    float _e1918 = (((_e1869 * _e1849) + (_e1887 * _e1854)) + (_e1908 * _e1859));
                    float _e1919 = (((_e1874 * _e1849) + (_e1892 * _e1854)) + (_e1913 * _e1859));
                    float _e1927 = lightbvh_instances.list[_e1495].columns[0u][0u];
                    float _e1932 = lightbvh_instances.list[_e1495].columns[0u][1u];
                    float _e1937 = lightbvh_instances.list[_e1495].columns[0u][2u];
                    float _e1942 = (((_e1927 * _e183.member.member_2[0]) + (_e1932 * _e183.member.member_2[1])) + (_e1937 * _e183.member.member_2[2]));
                    float _e1947 = lightbvh_instances.list[_e1495].columns[1u][0u];
                    float _e1952 = lightbvh_instances.list[_e1495].columns[1u][1u];
                    float _e1957 = lightbvh_instances.list[_e1495].columns[1u][2u];
                    float _e1962 = (((_e1947 * _e183.member.member_2[0]) + (_e1952 * _e183.member.member_2[1])) + (_e1957 * _e183.member.member_2[2]));
                    float _e1967 = lightbvh_instances.list[_e1495].columns[2u][0u];
                    float _e1972 = lightbvh_instances.list[_e1495].columns[2u][1u];
                    float _e1977 = lightbvh_instances.list[_e1495].columns[2u][2u];
                    float _e1982 = (((_e1967 * _e183.member.member_2[0]) + (_e1972 * _e183.member.member_2[1])) + (_e1977 * _e183.member.member_2[2]));
                    float _e1987 = ((uintBitsToFloat((floatBitsToUint(_e1942) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1942);
                    float _e1992 = ((uintBitsToFloat((floatBitsToUint(_e1962) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1962);
                    float _e1997 = ((uintBitsToFloat((floatBitsToUint(_e1982) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1982);
                    float _e2002 = (((_e1987 * _e1987) + (_e1992 * _e1992)) + (_e1997 * _e1997));
                    float _e2003 = uintBitsToFloat(67108864u);
                    v64_2 = 0.0;
                    if ((_e2002 >= _e2003)) {
                        float _e2009 = uintBitsToFloat((1597463007u - (floatBitsToUint(_e2002) >> uint(1))));
                        float _e2010 = (0.5 * _e2002);
                        float _e2014 = (_e2009 * (1.5 - ((_e2010 * _e2009) * _e2009)));
                        v64_2 = (_e2014 * (1.5 - ((_e2010 * _e2014) * _e2014)));
                    }
                    float _e2020 = v64_2;
                    float _e2021 = -(1.1529215e18);
                    v65_2 = _e2021;
                    if ((_e1917 < _e2021)) {
                    } else {
                        v65_2 = ((_e1917 > 1.1529215e18) ? 1.1529215e18 : _e1917);
                    }
                    float _e2026 = v65_2;
                    v66_2 = _e2021;
                    if ((_e1918 < _e2021)) {
                    } else {
                        v66_2 = ((_e1918 > 1.1529215e18) ? 1.1529215e18 : _e1918);
                    }
                    float _e2036 = v66_2;
                    v67_2 = _e2021;
                    if ((_e1919 < _e2021)) {
                    } else {
                        v67_2 = ((_e1919 > 1.1529215e18) ? 1.1529215e18 : _e1919);
                    }
                    float _e2046 = v67_2;
                    float _e2053 = (_e1987 * _e2020);
                    float _e2059 = (_e1992 * _e2020);
                    float _e2065 = (_e1997 * _e2020);
                    float _e2081 = ((uintBitsToFloat((floatBitsToUint(_e183.member.member_2[0]) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e183.member.member_2[0]);
                    float _e2086 = ((uintBitsToFloat((floatBitsToUint(_e183.member.member_2[1]) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e183.member.member_2[1]);
                    float _e2091 = ((uintBitsToFloat((floatBitsToUint(_e183.member.member_2[2]) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e183.member.member_2[2]);
                    float _e2096 = (((_e2081 * _e2081) + (_e2086 * _e2086)) + (_e2091 * _e2091));
                    float _e2098 = ((_e2096 > _e2003) ? _e2096 : _e2003);
                    float _e2103 = uintBitsToFloat((1597463007u - (floatBitsToUint(_e2098) >> uint(1))));
                    float _e2104 = (0.5 * _e2098);
                    float _e2108 = (_e2103 * (1.5 - ((_e2104 * _e2103) * _e2103)));
                    float _e2113 = (_e2098 * (_e2108 * (1.5 - ((_e2104 * _e2108) * _e2108))));
                    float _e2114 = (((uintBitsToFloat((floatBitsToUint(_e2053) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e2053) * _e2113);
                    float _e2115 = (((uintBitsToFloat((floatBitsToUint(_e2059) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e2059) * _e2113);
                    float _e2116 = (((uintBitsToFloat((floatBitsToUint(_e2065) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e2065) * _e2113);
                    float _e2142 = ((uintBitsToFloat((floatBitsToUint(_e183.member.member_1[0]) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e183.member.member_1[0]);
                    float _e2147 = ((uintBitsToFloat((floatBitsToUint(_e183.member.member_1[1]) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e183.member.member_1[1]);
                    float _e2152 = ((uintBitsToFloat((floatBitsToUint(_e183.member.member_1[2]) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e183.member.member_1[2]);
                    float _e2192 = (((uintBitsToFloat((floatBitsToUint(_e1864) & 2147483647u)) * _e2142) + (uintBitsToFloat((floatBitsToUint(_e1882) & 2147483647u)) * _e2147)) + (uintBitsToFloat((floatBitsToUint(_e1903) & 2147483647u)) * _e2152));
                    float _e2193 = (((uintBitsToFloat((floatBitsToUint(_e1869) & 2147483647u)) * _e2142) + (uintBitsToFloat((floatBitsToUint(_e1887) & 2147483647u)) * _e2147)) + (uintBitsToFloat((floatBitsToUint(_e1908) & 2147483647u)) * _e2152));
                    float _e2194 = (((uintBitsToFloat((floatBitsToUint(_e1874) & 2147483647u)) * _e2142) + (uintBitsToFloat((floatBitsToUint(_e1892) & 2147483647u)) * _e2147)) + (uintBitsToFloat((floatBitsToUint(_e1913) & 2147483647u)) * _e2152));
                    float _e2196 = ((_e2192 < 1.1529215e18) ? _e2192 : 1.1529215e18);
                    float _e2198 = ((_e2193 < 1.1529215e18) ? _e2193 : 1.1529215e18);
                    float _e2200 = ((_e2194 < 1.1529215e18) ? _e2194 : 1.1529215e18);
                    v60_2 = LightbvhType32_(_e1824.member, _e1824.member_1, LightbvhType31_(_e1824.member_2.member, _e1824.member_2.member_1, _e1824.member_2.member_2, _e1824.member_2.member_3, _e1824.member_2.member_4, _e1824.member_2.member_5, _e1824.member_2.member_6, _e1824.member_2.member_7, _e1824.member_2.member_8, _e1824.member_2.member_9, LightbvhType29_(float[3](((uintBitsToFloat((floatBitsToUint(_e2026) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e2026), ((uintBitsToFloat((floatBitsToUint(_e2036) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e2036), ((uintBitsToFloat((floatBitsToUint(_e2046) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e2046)), float[3](((uintBitsToFloat((floatBitsToUint(_e2196) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e2196), ((uintBitsToFloat((floatBitsToUint(_e2198) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e2198), ((uintBitsToFloat((floatBitsToUint(_e2200) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e2200)), float[3](((uintBitsToFloat((floatBitsToUint(_e2114) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e2114), ((uintBitsToFloat((floatBitsToUint(_e2115) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e2115), ((uintBitsToFloat((floatBitsToUint(_e2116) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e2116))), _e1824.member_2.member_11, _e1824.member_2.member_12, _e1824.member_2.member_13));
                }
                LightbvhType32_ _e1577 = v60_2;
                v68_2 = _e1577;
                if (_e1504) {
                } else {
                    v61_2 = _e578.member_2.member_4;
                    if (_e1508) {
                        v61_2 = (_e1393 + (_e1073 ? _e157 : 0u));
                    }
                    uint _e1581 = v61_2;
                    LightbvhType32_ _e1600 = LightbvhType32_(_e1575.member, _e1575.member_1, LightbvhType31_(_e1575.member_2.member, _e1575.member_2.member_1, _e1575.member_2.member_2, _e1575.member_2.member_3, _e1581, _e1575.member_2.member_5, _e1575.member_2.member_6, _e1575.member_2.member_7, _e1575.member_2.member_8, _e1575.member_2.member_9, _e1575.member_2.member_10, _e1575.member_2.member_11, _e1575.member_2.member_12, _e1575.member_2.member_13));
                    v68_2 = LightbvhType32_(_e1600.member, _e1600.member_1, LightbvhType31_(_e1600.member_2.member, _e1600.member_2.member_1, _e1600.member_2.member_2, _e1600.member_2.member_3, _e1600.member_2.member_4, _e1600.member_2.member_5, _e1600.member_2.member_6, (_e578.member_2.member_7 + (_e1508 ? 1u : 0u)), _e1600.member_2.member_8, _e1600.member_2.member_9, _e1600.member_2.member_10, _e1600.member_2.member_11, _e1600.member_2.member_12, _e1600.member_2.member_13));
                }
                LightbvhType32_ _e2239 = v68_2;
                v69_2 = _e1050;
                v70_2 = _e2239;
                v71_2 = _e2239.member_2.member_12;
            }
            bool _e2243 = v69_2;
            LightbvhType32_ _e2245 = v70_2;
            bool _e2247 = v71_2;
            continue;
        }
        bool _e2251 = v72_2;
        if (_e2251) {
            break;
        }
        LightbvhType32_ _e2253 = v73_2;
        bool _e2255 = (_e2253.member != 4294967295u);
        LightbvhType32_ _e2257 = v74_2;
        LightbvhType32_ _e2263 = v75_2;
        LightbvhType32_ _e2267 = v76_2;
        bool _e2271 = ((_e2257.member_2.member_5 != 4294967295u) && (!(_e2255) || (_e2263.member_2.member_6 == _e2267.member_1)));
        uint _e2272 = (_e2255 ? _e2267.member_1 : _e2263.member_2.member_6);
        v78_2 = _e2253.member;
        if (_e2255) {
        } else {
            bool _e2273 = (_e2263.member_2.member_6 < _e151);
            v77_2 = _e2257.member_2.member_5;
            if (_e2273) {
                if (_e2273) {
                } else {
                    break;
                }
                uint _e2276 = lightbvh_instances.list[_e2263.member_2.member_6].first_light;
                uint _e2280 = lightbvh_instances.list[_e2263.member_2.member_6].first;
                v77_2 = ((_e2257.member_2.member_5 - _e2276) + _e2280);
            }
            uint _e2283 = v77_2;
            v78_2 = _e2283;
        }
        uint _e2285 = v78_2;
        v81_2 = 0.0;
        if (_e2271) {
            LightbvhType32_ _e2287 = v79_2;
            LightbvhType32_ _e2293 = v80_2;
            int _e2300 = -(int((22u + ((_e2287.member_2.member_9 < 98u) ? _e2287.member_2.member_9 : 98u))));
            int _e2302 = ((_e2300 < -126) ? -126 : _e2300);
            v81_2 = (float(int(_e2293.member_2.member_8)) * uintBitsToFloat((uint((((_e2302 > 127) ? 127 : _e2302) + 127)) << uint(23))));
        }
        float _e2312 = v81_2;
        v83_2 = 0u;
        v84_2 = true;
        if ((_e175 > 0u)) {
            bool _e2314 = (_e2272 < _e151);
            v82_2 = 0u;
            if (_e2314) {
                if (_e2314) {
                } else {
                    break;
                }
                uint _e2317 = lightbvh_instances.list[_e2272].count;
                v82_2 = _e2317;
            }
            uint _e2319 = v82_2;
            v83_2 = _e2319;
            v84_2 = (_e2314 ? false : true);
        }
        uint _e2322 = v83_2;
        bool _e2324 = v84_2;
        uint _e2329 = ((_e2324 ? _e178 : _e2322) & 2147483647u);
        uint _e2334 = floatBitsToUint((float(65536) * uintBitsToFloat(880803840u)));
        uint _e2335 = floatBitsToUint(float(int(((_e2329 > 0u) ? _e2329 : 1u))));
        uint _e2340 = ((_e2334 >> uint(23)) & 255u);
        uint _e2344 = (_e2334 & 8388607u);
        uint _e2345 = (_e2344 | 8388608u);
        uint _e2346 = (_e2335 & 8388607u);
        uint _e2347 = (_e2346 | 8388608u);
        bool _e2348 = (_e2345 < _e2347);
        float _e2352 = uintBitsToFloat((_e2346 | 1065353216u));
        uint _e2353 = floatBitsToUint(_e2352);
        float _e2358 = uintBitsToFloat(((_e2353 & 2147483648u) | (2129859015u - (_e2353 & 2147483647u))));
        float _e2361 = (_e2358 * (2.0 - (_e2352 * _e2358)));
        float _e2364 = (_e2361 * (2.0 - (_e2352 * _e2361)));
        float _e2368 = ((uintBitsToFloat((_e2344 | 1065353216u)) * _e2364) * (_e2348 ? 16777216.0 : 8388608.0));
        float _e2369 = uintBitsToFloat(0u);
        float _e2370 = uintBitsToFloat(1333788671u);
        uint _e2375 = ((_e2368 > _e2370) ? 4294967295u : ((_e2368 < _e2369) ? 0u : uint(_e2368)));
        int _e2381 = int(((_e2345 << uint(((_e2348 ? 24 : 23) & 31))) - (_e2375 * _e2347)));
        float _e2386 = ((float((_e2381 >> uint(8))) * _e2364) * 3.0517578e-5);
        float _e2387 = uintBitsToFloat(3472883712u);
        float _e2388 = uintBitsToFloat(1325400063u);
        int _e2395 = ((_e2386 == _e2386) ? ((_e2386 > _e2388) ? 2147483647 : ((_e2386 < _e2387) ? -2147483648 : int(_e2386))) : 0);
        uint _e2397 = (_e2375 + uint(_e2395));
        int _e2398 = int(_e2347);
        int _e2400 = (_e2381 - (_e2395 * _e2398));
        bool _e2401 = (_e2400 < 0);
        v85_2 = _e2397;
        if (_e2401) {
            v85_2 = (_e2397 - 1u);
        }
        uint _e2404 = v85_2;
        v86_2 = _e2400;
        if (_e2401) {
            v86_2 = (_e2400 + _e2398);
        }
        int _e2407 = v86_2;
        bool _e2408 = (_e2407 >= _e2398);
        v87_2 = _e2404;
        if (_e2408) {
            v87_2 = (_e2404 + 1u);
        }
        uint _e2411 = v87_2;
        v88_2 = _e2407;
        if (_e2408) {
            v88_2 = (_e2407 - _e2398);
        }
        int _e2414 = v88_2;
        v89_1 = _e2411;
        if (((_e2414 * 2) > _e2398)) {
            v89_1 = (_e2411 + 1u);
        }
        uint _e2419 = v89_1;
        int _e2424 = ((int(_e2340) - int(((_e2335 >> uint(23)) & 255u))) + (_e2348 ? 126 : 127));
        v92_1 = 0u;
        v93_1 = true;
        if ((_e2340 == 0u)) {
        } else {
            bool _e2426 = (_e2424 <= 0);
            v91_1 = 0u;
            if (_e2426) {
            } else {
                v90_1 = 2139095040u;
                if ((_e2424 >= 255)) {
                } else {
                    v90_1 = ((uint(_e2424) << uint(23)) + (_e2419 & 8388607u));
                }
                uint _e2434 = v90_1;
                v91_1 = _e2434;
            }
            uint _e2436 = v91_1;
            v92_1 = _e2436;
            v93_1 = _e2426;
        }
        uint _e2438 = v92_1;
        bool _e2440 = v93_1;
        uint _e2444 = (_e175 & 2147483647u);
        uint _e2449 = floatBitsToUint(uintBitsToFloat((((_e2334 ^ _e2335) & 2147483648u) | (_e2440 ? 0u : _e2438))));
        uint _e2450 = floatBitsToUint(float(int(((_e2444 > 0u) ? _e2444 : 1u))));
        uint _e2455 = ((_e2449 >> uint(23)) & 255u);
        uint _e2459 = (_e2449 & 8388607u);
        uint _e2460 = (_e2459 | 8388608u);
        uint _e2461 = (_e2450 & 8388607u);
        uint _e2462 = (_e2461 | 8388608u);
        bool _e2463 = (_e2460 < _e2462);
        float _e2467 = uintBitsToFloat((_e2461 | 1065353216u));
        uint _e2468 = floatBitsToUint(_e2467);
        float _e2473 = uintBitsToFloat(((_e2468 & 2147483648u) | (2129859015u - (_e2468 & 2147483647u))));
        float _e2476 = (_e2473 * (2.0 - (_e2467 * _e2473)));
        float _e2479 = (_e2476 * (2.0 - (_e2467 * _e2476)));
        float _e2483 = ((uintBitsToFloat((_e2459 | 1065353216u)) * _e2479) * (_e2463 ? 16777216.0 : 8388608.0));
        uint _e2488 = ((_e2483 > _e2370) ? 4294967295u : ((_e2483 < _e2369) ? 0u : uint(_e2483)));
        int _e2494 = int(((_e2460 << uint(((_e2463 ? 24 : 23) & 31))) - (_e2488 * _e2462)));
        float _e2499 = ((float((_e2494 >> uint(8))) * _e2479) * 3.0517578e-5);
        int _e2506 = ((_e2499 == _e2499) ? ((_e2499 > _e2388) ? 2147483647 : ((_e2499 < _e2387) ? -2147483648 : int(_e2499))) : 0);
        uint _e2508 = (_e2488 + uint(_e2506));
        int _e2509 = int(_e2462);
        int _e2511 = (_e2494 - (_e2506 * _e2509));
        bool _e2512 = (_e2511 < 0);
        v94_1 = _e2508;
        if (_e2512) {
            v94_1 = (_e2508 - 1u);
        }
        uint _e2515 = v94_1;
        v95_1 = _e2511;
        if (_e2512) {
            v95_1 = (_e2511 + _e2509);
        }
        int _e2518 = v95_1;
        bool _e2519 = (_e2518 >= _e2509);
        v96_1 = _e2515;
        if (_e2519) {
            v96_1 = (_e2515 + 1u);
        }
        uint _e2522 = v96_1;
        v97_1 = _e2518;
        if (_e2519) {
            v97_1 = (_e2518 - _e2509);
        }
        int _e2525 = v97_1;
        v98_1 = _e2522;
        if (((_e2525 * 2) > _e2509)) {
            v98_1 = (_e2522 + 1u);
        }
        uint _e2530 = v98_1;
        int _e2535 = ((int(_e2455) - int(((_e2450 >> uint(23)) & 255u))) + (_e2463 ? 126 : 127));
        v101_1 = 0u;
        v102_1 = true;
        if ((_e2455 == 0u)) {
        } else {
            bool _e2537 = (_e2535 <= 0);
            v100_1 = 0u;
            if (_e2537) {
            } else {
                v99_1 = 2139095040u;
                if ((_e2535 >= 255)) {
                } else {
                    v99_1 = ((uint(_e2535) << uint(23)) + (_e2530 & 8388607u));
                }
                uint _e2545 = v99_1;
                v100_1 = _e2545;
            }
            uint _e2547 = v100_1;
            v101_1 = _e2547;
            v102_1 = _e2537;
        }
        uint _e2549 = v101_1;
        bool _e2551 = v102_1;
        v103_1 = LightbvhType19_(4294967295u, 4294967295u, 0.0);
        if ((_e2255 || _e2271)) {
            v103_1 = LightbvhType19_(_e2285, _e2272, (_e2312 + uintBitsToFloat((((_e2449 ^ _e2450) & 2147483648u) | (_e2551 ? 0u : _e2549)))));
        }
        LightbvhType19_ _e2559 = v103_1;
        results_2 = _e2559;
        break;
    } while(false);
    LightbvhType19_ _e2665 = results_2;
    return LightbvhLightSample(_e2665.member, _e2665.member_1, _e2665.member_2);
}

float lightbvh_pmf_cell(vec3 center_1, vec3 half_1, vec3 n_3, uint light_1, uint instance_1) {
    LightbvhType30_ queries_3 = LightbvhType30_(LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), uint[2](0u, 0u));
    float results_3 = 0.0;
    float v0_3[8] = float[8](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    uint v1_3 = 0u;
    uint v2_3 = 0u;
    bool v3_3 = false;
    uint v4_3 = 0u;
    uint v5_3 = 0u;
    uint v6_3 = 0u;
    bool v7_3 = false;
    bool v8_3 = false;
    LightbvhType24_ v9_3 = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
    uint v10_3 = 0u;
    uint v11_3 = 0u;
    uint v12_3 = 0u;
    uint v13_3 = 0u;
    bool v14_3 = false;
    uint v15_3 = 0u;
    LightbvhType23_ v16_3 = LightbvhType23_(0u, 0u);
    uint v17_3 = 0u;
    uint v18_3 = 0u;
    uint v19_3 = 0u;
    LightbvhType23_ v20_3 = LightbvhType23_(0u, 0u);
    uint v21_3 = 0u;
    uint v22_3 = 0u;
    LightbvhType23_ v23_3 = LightbvhType23_(0u, 0u);
    uint v24_3 = 0u;
    bool v25_3 = false;
    bool v26_3 = false;
    LightbvhType23_ v27_3 = LightbvhType23_(0u, 0u);
    bool v28_3 = false;
    LightbvhType24_ v29_3 = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
    bool v30_3 = false;
    LightbvhType31_ v31_3 = LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false);
    bool v32_3 = false;
    LightbvhType23_ v33_3 = LightbvhType23_(0u, 0u);
    LightbvhType23_ v34_3 = LightbvhType23_(0u, 0u);
    LightbvhType23_ v35_3 = LightbvhType23_(0u, 0u);
    LightbvhType23_ v36_3 = LightbvhType23_(0u, 0u);
    LightbvhType23_ v37_3 = LightbvhType23_(0u, 0u);
    bool v38_3 = false;
    uint v39_3 = 0u;
    uint v40_3 = 0u;
    uint v41_3 = 0u;
    uint v42_3 = 0u;
    int v43_3 = 0;
    uint v44_3 = 0u;
    bool v45_3 = false;
    LightbvhType31_ v46_3 = LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false);
    uint v47_3 = 0u;
    uint v48_3 = 0u;
    LightbvhType31_ v49_3 = LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false);
    float v50_3 = 0.0;
    float v51_3 = 0.0;
    float v52_3 = 0.0;
    float v53_3 = 0.0;
    LightbvhType31_ v54_3 = LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false);
    bool v55_3 = false;
    LightbvhType31_ v56_3 = LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false);
    bool v57_3 = false;
    bool v58_3 = false;
    LightbvhType31_ v59_3 = LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false);
    LightbvhType31_ v60_3 = LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false);
    LightbvhType31_ v61_3 = LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false);
    LightbvhType31_ v62_3 = LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false);
    float v63_3 = 0.0;
    uint v64_3 = 0u;
    uint v65_3 = 0u;
    bool v66_3 = false;
    uint v67_3 = 0u;
    int v68_3 = 0;
    uint v69_3 = 0u;
    int v70_3 = 0;
    uint v71_3 = 0u;
    uint v72_3 = 0u;
    uint v73_3 = 0u;
    uint v74_3 = 0u;
    bool v75_3 = false;
    uint v76_3 = 0u;
    int v77_3 = 0;
    uint v78_3 = 0u;
    int v79_3 = 0;
    uint v80_3 = 0u;
    uint v81_3 = 0u;
    uint v82_3 = 0u;
    uint v83_3 = 0u;
    bool v84_3 = false;
    bool v85_3 = false;
    bool v86_3 = false;
    bool v87_3 = false;
    float v88_3 = 0.0;
    queries_3 = LightbvhType30_(LightbvhType29_(float[3](center_1.x, center_1.y, center_1.z), float[3](half_1.x, half_1.y, half_1.z), float[3](n_3.x, n_3.y, n_3.z)), uint[2](light_1, instance_1));
    do {
        uint _e142 = uint(lightbvh_nodes.list.length());
        uint _e145 = uint(lightbvh_instances.list.length());
        uint _e148 = uint(lightbvh_trails.list.length());
        uint _e151 = lightbvh_tree.top;
        uint _e154 = lightbvh_tree.root;
        uint _e157 = lightbvh_tree.above;
        uint _e160 = lightbvh_tree.places;
        uint _e163 = lightbvh_tree.parts;
        uint _e166 = lightbvh_tree.trail_words;
        uint _e169 = lightbvh_tree.live;
        uint _e172 = lightbvh_tree.lights;
        uint _e175 = lightbvh_tree.depth;
        LightbvhType30_ _e177 = queries_3;
        bool _e183 = (_e169 > 0u);
        uint _e184 = (_e183 ? _e177.member_1[1] : 4294967295u);
        bool _e185 = (_e184 < _e145);
        v2_3 = 0u;
        v3_3 = true;
        if (_e185) {
            v1_3 = 0u;
            if (_e183) {
                if (_e185) {
                } else {
                    break;
                }
                uint _e188 = lightbvh_instances.list[_e184].first;
                uint _e192 = lightbvh_instances.list[_e184].first_light;
                v1_3 = ((_e177.member_1[0] - _e188) + _e192);
            }
            uint _e195 = v1_3;
            v2_3 = _e195;
            v3_3 = (_e183 ? false : true);
        }
        uint _e198 = v2_3;
        bool _e200 = v3_3;
        uint _e201 = (_e200 ? _e177.member_1[0] : _e198);
        uint _e202 = (_e201 * _e166);
        bool _e203 = (_e202 < _e148);
        v4_3 = 0u;
        if (_e203) {
            if (_e203) {
            } else {
                break;
            }
            uint _e205 = lightbvh_trails.list[_e202];
            v4_3 = _e205;
        }
        uint _e207 = v4_3;
        v6_3 = 0u;
        v7_3 = true;
        if ((_e166 == 2u)) {
            uint _e209 = (_e202 + 1u);
            bool _e210 = (_e209 < _e148);
            v5_3 = 0u;
            if (_e210) {
                if (_e210) {
                } else {
                    break;
                }
                uint _e212 = lightbvh_trails.list[_e209];
                v5_3 = _e212;
            }
            uint _e214 = v5_3;
            v6_3 = _e214;
            v7_3 = (_e210 ? false : true);
        }
        uint _e217 = v6_3;
        bool _e219 = v7_3;
        uint _e220 = (_e219 ? 0u : _e217);
        v8_3 = false;
        v9_3 = LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u));
        if (_e185) {
            uint _e227 = (_e160 + _e184);
            bool _e228 = (_e227 < _e148);
            v10_3 = 4294967295u;
            if (_e228) {
                if (_e228) {
                } else {
                    break;
                }
                uint _e230 = lightbvh_trails.list[_e227];
                v10_3 = _e230;
            }
            uint _e232 = v10_3;
            v13_3 = 0u;
            v14_3 = true;
            if ((_e232 != 4294967295u)) {
                bool _e234 = (_e232 >= 2147483648u);
                v12_3 = 0u;
                if (_e234) {
                    uint _e238 = (_e163 + ((_e232 - 2147483648u) + (_e207 & 7u)));
                    bool _e239 = (_e238 < _e148);
                    v11_3 = 4294967295u;
                    if (_e239) {
                        if (_e239) {
                        } else {
                            break;
                        }
                        uint _e241 = lightbvh_trails.list[_e238];
                        v11_3 = _e241;
                    }
                    uint _e243 = v11_3;
                    v12_3 = _e243;
                }
                uint _e245 = v12_3;
                v13_3 = _e245;
                v14_3 = (_e234 ? false : true);
            }
            uint _e248 = v13_3;
            bool _e250 = v14_3;
            v15_3 = 0u;
            v16_3 = LightbvhType23_(0u, 0u);
            v17_3 = (_e250 ? _e232 : _e248);
            bool loop_init_9 = true;
            while(true) {
                if (!loop_init_9) {
                    v15_3 = v22_3;
                    v16_3 = v23_3;
                    v17_3 = v24_3;
                    v26_3 = false;
                    if (!(v25_3)) {
                        break;
                    }
                }
                loop_init_9 = false;
                uint _e253 = v15_3;
                LightbvhType23_ _e255 = v16_3;
                uint _e257 = v17_3;
                v27_3 = _e255;
                v22_3 = 0u;
                v23_3 = LightbvhType23_(0u, 0u);
                v24_3 = 0u;
                v25_3 = false;
                if ((_e257 < 2147483648u)) {
                    bool _e259 = (_e253 < 20u);
                    v19_3 = 0u;
                    v20_3 = LightbvhType23_(0u, 0u);
                    v21_3 = 0u;
                    if (_e259) {
                        uint _e278 = (_e157 + (_e257 >> 3u));
                        bool _e279 = (_e278 < _e148);
                        v18_3 = 4294967295u;
                        if (_e279) {
                            if (_e279) {
                            } else {
                                v26_3 = true;
                                break;
                            }
                            uint _e281 = lightbvh_trails.list[_e278];
                            v18_3 = _e281;
                        }
                        uint _e283 = v18_3;
                        v19_3 = (_e253 + 1u);
                        v20_3 = LightbvhType23_((((_e255.member << 3u) | ((_e257 & 7u) & 7u)) & 1073741823u), (((_e255.member_1 << 3u) | ((_e255.member >> 27u) & 7u)) & 1073741823u));
                        v21_3 = _e283;
                    }
                    uint _e286 = v19_3;
                    LightbvhType23_ _e288 = v20_3;
                    uint _e290 = v21_3;
                    v22_3 = _e286;
                    v23_3 = _e288;
                    v24_3 = _e290;
                    v25_3 = _e259;
                }
                uint _e292 = v22_3;
                LightbvhType23_ _e294 = v23_3;
                uint _e296 = v24_3;
                bool _e298 = v25_3;
                continue;
            }
            bool _e301 = v26_3;
            if (_e301) {
                break;
            }
            LightbvhType23_ _e304 = v27_3;
            v8_3 = _e301;
            v9_3 = LightbvhType24_(_e304, LightbvhType23_(_e207, _e220));
        }
        bool _e222 = v8_3;
        LightbvhType24_ _e224 = v9_3;
        v28_3 = _e222;
        v29_3 = _e224;
        if (_e185) {
        } else {
            v28_3 = false;
            v29_3 = LightbvhType24_(LightbvhType23_(_e207, _e220), LightbvhType23_(0u, 0u));
        }
        bool _e307 = v28_3;
        LightbvhType24_ _e309 = v29_3;
        bool _e311 = (_e175 == 0u);
        LightbvhType31_ _e312 = LightbvhType31_(_e309, LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 1.0), 0u, (_e154 + _e151), 4294967295u, 4294967295u, 0u, 4194304u, 0u, _e177.member, _e175, _e311, true);
        uint _e315 = (uint(21) - uint(findMSB(4128767u)));
        uint _e317 = ((_e315 < 22u) ? _e315 : 22u);
        uint _e318 = (_e317 & 31u);
        LightbvhType31_ _e336 = LightbvhType31_(_e312.member, LightbvhType23_((4227858432u << _e318), 0u), _e312.member_2, _e312.member_3, _e312.member_4, _e312.member_5, _e312.member_6, _e312.member_7, _e312.member_8, _e312.member_9, _e312.member_10, _e312.member_11, _e312.member_12, _e312.member_13);
        LightbvhType31_ _e353 = LightbvhType31_(_e336.member, _e336.member_1, _e336.member_2, _e336.member_3, _e336.member_4, _e336.member_5, _e336.member_6, _e336.member_7, (4128768u << _e318), _e336.member_9, _e336.member_10, _e336.member_11, _e336.member_12, _e336.member_13);
        v30_3 = _e307;
        v31_3 = LightbvhType31_(_e353.member, _e353.member_1, _e353.member_2, _e353.member_3, _e353.member_4, _e353.member_5, _e353.member_6, _e353.member_7, _e353.member_8, _e317, _e353.member_10, _e353.member_11, _e353.member_12, _e353.member_13);
        v32_3 = _e311;
        bool loop_init_10 = true;
        while(true) {
            if (!loop_init_10) {
                v30_3 = v55_3;
                v31_3 = v56_3;
                v32_3 = v57_3;
                v58_3 = v55_3;
                if (!((v32_3 ? false : true))) {
                    break;
                }
            }
            loop_init_10 = false;
            bool _e370 = v30_3;
            LightbvhType31_ _e372 = v31_3;
            bool _e374 = v32_3;
            v59_3 = _e372;
            v60_3 = _e372;
            v61_3 = _e372;
            v62_3 = _e372;
            v55_3 = _e370;
            v56_3 = LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false);
            v57_3 = false;
            if (_e374) {
            } else {
                bool _e376 = (_e372.member_4 < _e142);
                uint _e377 = (_e376 ? _e372.member_4 : 0u);
                if ((_e377 < _e142)) {
                } else {
                    v58_3 = true;
                    break;
                }
                uint _e409 = lightbvh_nodes.list[_e377][0u][3u];
                int _e412 = (int((_e409 & 255u)) - 127);
                float _e422 = uintBitsToFloat((floatBitsToUint(_e372.member_10.member_1[0]) & 2147483647u));
                float _e425 = uintBitsToFloat((floatBitsToUint(_e372.member_10.member_1[1]) & 2147483647u));
                float _e428 = uintBitsToFloat((floatBitsToUint(_e372.member_10.member_1[2]) & 2147483647u));
                float _e430 = ((_e422 > _e425) ? _e422 : _e425);
                int _e438 = (int(((floatBitsToUint(((_e430 > _e428) ? _e430 : _e428)) >> uint(23)) & 255u)) - 127);
                int _e440 = ((_e438 > _e412) ? _e438 : _e412);
                float _e446 = (1.0 - (((_e372.member_10.member_2[0] * _e372.member_10.member_2[0]) + (_e372.member_10.member_2[1] * _e372.member_10.member_2[1])) + (_e372.member_10.member_2[2] * _e372.member_10.member_2[2])));
                float _e448 = ((_e446 > 3.8146973e-6) ? _e446 : 3.8146973e-6);
                float _e453 = uintBitsToFloat((1595932665u - (floatBitsToUint(_e448) >> uint(1))));
                float _e460 = (0.5 * (_e448 * (_e453 * (0.70395225 * (2.3892446 - (_e448 * (_e453 * _e453)))))));
                float _e462 = (0.0001 + _e460);
                uint _e466 = lightbvh_nodes.list[_e377][0u][0u];
                uint _e471 = lightbvh_nodes.list[_e377][0u][1u];
                uint _e476 = lightbvh_nodes.list[_e377][0u][2u];
                float _e478 = (uintBitsToFloat(_e466) - _e372.member_10.member[0]);
                float _e479 = (uintBitsToFloat(_e471) - _e372.member_10.member[1]);
                float _e480 = (uintBitsToFloat(_e476) - _e372.member_10.member[2]);
                float _e483 = uintBitsToFloat((floatBitsToUint(_e478) & 2147483647u));
                float _e486 = uintBitsToFloat((floatBitsToUint(_e479) & 2147483647u));
                float _e489 = uintBitsToFloat((floatBitsToUint(_e480) & 2147483647u));
                float _e491 = ((_e483 > _e486) ? _e483 : _e486);
                int _e499 = (int(((floatBitsToUint(((_e491 > _e489) ? _e491 : _e489)) >> uint(23)) & 255u)) - 127);
                int _e501 = ((_e499 > _e440) ? _e499 : _e440);
                int _e502 = (_e412 - _e501);
                int _e504 = ((_e502 < -40) ? -40 : _e502);
                int _e505 = -(_e501);
                int _e507 = ((_e505 < -126) ? -126 : _e505);
                float _e514 = uintBitsToFloat((uint((((_e507 > 127) ? 127 : _e507) + 127)) << uint(23)));
                int _e519 = ((_e504 < -126) ? -126 : _e504);
                float _e526 = uintBitsToFloat((uint((((_e519 > 127) ? 127 : _e519) + 127)) << uint(23)));
                float _e527 = (_e372.member_10.member_1[0] * _e514);
                float _e528 = (_e372.member_10.member_1[1] * _e514);
                float _e529 = (_e372.member_10.member_1[2] * _e514);
                float _e532 = uintBitsToFloat((floatBitsToUint(_e372.member_10.member_2[0]) & 2147483647u));
                float _e535 = uintBitsToFloat((floatBitsToUint(_e372.member_10.member_2[1]) & 2147483647u));
                float _e538 = uintBitsToFloat((floatBitsToUint(_e372.member_10.member_2[2]) & 2147483647u));
                float _e543 = (((_e527 * _e532) + (_e528 * _e535)) + (_e529 * _e538));
                float _e550 = ((0.22222222 * (((_e527 * _e527) + (_e528 * _e528)) + (_e529 * _e529))) + 8.881784e-16);
                float _e552 = (_e526 * 4.656613e-10);
                float _e555 = (2.0 * 8.0);
                float _e556 = (_e532 * _e555);
                float _e557 = (_e535 * _e555);
                float _e558 = (_e538 * _e555);
                v0_3 = float[8](0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
                v33_3 = LightbvhType23_(0u, 8u);
                bool loop_init_11 = true;
                while(true) {
                    if (!loop_init_11) {
                        v33_3 = v36_3;
                        v38_3 = _e370;
                        if (!((int(v37_3.member) != 0))) {
                            break;
                        }
                    }
                    loop_init_11 = false;
                    LightbvhType23_ _e565 = v33_3;
                    bool _e568 = (_e565.member < _e565.member_1);
                    v34_3 = LightbvhType23_(0u, 0u);
                    v35_3 = LightbvhType23_(0u, 0u);
                    if (_e568) {
                        v34_3 = LightbvhType23_((_e565.member + 1u), _e565.member_1);
                        v35_3 = LightbvhType23_(1u, _e565.member);
                    }
                    LightbvhType23_ _e570 = v34_3;
                    LightbvhType23_ _e572 = v35_3;
                    v36_3 = _e570;
                    v37_3 = _e572;
                    if (_e568) {
                    } else {
                        v36_3 = _e565;
                        v37_3 = LightbvhType23_(0u, LightbvhType23_(0u, 0u).member_1);
                    }
                    LightbvhType23_ _e582 = v36_3;
                    LightbvhType23_ _e584 = v37_3;
                    bool _e588 = (int(_e584.member) != 0);
                    if (_e588) {
                        bool _e589 = (_e584.member_1 < 8u);
                        if (_e589) {
                        } else {
                            v38_3 = true;
                            break;
                        }
                        uint _e593 = lightbvh_nodes.list[_e377][1u][_e584.member_1];
                        if (_e589) {
                        } else {
                            v38_3 = true;
                            break;
                        }
                        uint _e597 = lightbvh_nodes.list[_e377][2u][_e584.member_1];
                        if (_e589) {
                        } else {
                            v38_3 = true;
                            break;
                        }
                        uint _e601 = lightbvh_nodes.list[_e377][3u][_e584.member_1];
                        if (_e589) {
                        } else {
                            v38_3 = true;
                            break;
                        }
                        uint _e605 = lightbvh_nodes.list[_e377][4u][_e584.member_1];
                        float _e621 = ((_e478 * _e514) + (float(int(_e593)) * _e552));
                        float _e622 = ((_e479 * _e514) + (float(int((_e593 << 15u))) * _e552));
                        float _e623 = ((_e480 * _e514) + (float(int(_e597)) * _e552));
                        float _e628 = uintBitsToFloat((((_e605 << 20u) & 267386880u) + (floatBitsToUint(_e526) + 4043309056u)));
                        float _e635 = float(int(_e601));
                        float _e639 = float(int((_e601 << 8u)));
                        float _e643 = float(int((_e601 << 16u)));
                        float _e647 = (float(int((_e601 & 255u))) * 0.003921569);
                        float _e664 = (_e628 * _e628);
                        float _e665 = (1.0 + (float(int((_e597 << 15u))) * 4.656613e-10));
                        float _e666 = (_e664 + _e550);
                        float _e669 = ((_e664 * (_e665 * _e665)) + _e550);
                        float _e674 = uintBitsToFloat((1595932665u - (floatBitsToUint(_e666) >> uint(1))));
                        float _e679 = (_e674 * (0.70395225 * (2.3892446 - (_e666 * (_e674 * _e674)))));
                        float _e680 = (_e666 * _e679);
                        float _e685 = uintBitsToFloat((1595932665u - (floatBitsToUint(_e669) >> uint(1))));
                        float _e693 = (((_e669 * (_e685 * (0.70395225 * (2.3892446 - (_e669 * (_e685 * _e685)))))) * _e679) - 1.0);
                        float _e706 = (uintBitsToFloat((floatBitsToUint(_e621) & 2147483647u)) - _e527);
                        float _e707 = (uintBitsToFloat((floatBitsToUint(_e622) & 2147483647u)) - _e528);
                        float _e708 = (uintBitsToFloat((floatBitsToUint(_e623) & 2147483647u)) - _e529);
                        float _e710 = ((_e706 > 0.0) ? _e706 : 0.0);
                        float _e712 = ((_e707 > 0.0) ? _e707 : 0.0);
                        float _e714 = ((_e708 > 0.0) ? _e708 : 0.0);
                        float _e715 = (_e680 * _e680);
                        float _e721 = ((((_e621 * _e621) + (_e622 * _e622)) + (_e623 * _e623)) + 8.881784e-16);
                        float _e731 = (_e721 + (1.25 * _e715));
                        float _e736 = uintBitsToFloat((1595932665u - (floatBitsToUint(_e731) >> uint(1))));
                        float _e741 = (_e736 * (0.70395225 * (2.3892446 - (_e731 * (_e736 * _e736)))));
                        float _e742 = (_e680 * _e741);
                        float _e747 = ((((_e372.member_10.member_2[0] * 4.656613e-10) * _e635) + ((_e372.member_10.member_2[1] * 4.656613e-10) * _e639)) + ((_e372.member_10.member_2[2] * 4.656613e-10) * _e643));
                        float _e752 = ((0.03162278 + _e460) + (_e742 * (1.0 + (_e693 * (_e747 * _e747)))));
                        float _e758 = (((((_e372.member_10.member_2[0] + _e372.member_10.member_2[0]) * _e621) + ((_e372.member_10.member_2[1] + _e372.member_10.member_2[1]) * _e622)) + ((_e372.member_10.member_2[2] + _e372.member_10.member_2[2]) * _e623)) * _e741);
                        float _e760 = (_e758 + (((((((_e556 + _e557) + _e558) + ((((_e556 * 4.656613e-10) * float(int(_e605))) + ((_e557 * 4.656613e-10) * float(int((_e605 << 8u))))) + ((_e558 * 4.656613e-10) * float(int((_e605 << 16u)))))) * _e628) + (_e543 + _e543)) * _e679) * _e742));
                        float _e762 = ((_e760 > _e462) ? _e760 : _e462);
                        float _e768 = (uintBitsToFloat((floatBitsToUint(_e758) & 2147483647u)) + _e752);
                        float _e774 = (1.0 + _e693);
                        float _e780 = ((((_e635 * _e621) + (_e639 * _e622)) + (_e643 * _e623)) * (-2.0 * 4.656613e-10));
                        float _e783 = (_e680 * ((_e774 > _e647) ? _e774 : _e647));
                        float _e785 = (_e721 - (2.5 * _e715));
                        float _e787 = (0.25 * (_e780 * _e780));
                        float _e793 = ((((_e785 > _e787) ? _e785 : _e787) + 8.881784e-16) + (1.25 * (_e783 * _e783)));
                        float _e798 = uintBitsToFloat((1595932665u - (floatBitsToUint(_e793) >> uint(1))));
                        float _e803 = (_e798 * (0.70395225 * (2.3892446 - (_e793 * (_e798 * _e798)))));
                        float _e805 = ((_e680 * _e803) * _e774);
                        float _e809 = ((0.03162278 + _e805) + (_e647 * (0.5 - _e805)));
                        float _e810 = (_e780 * _e803);
                        float _e814 = (uintBitsToFloat((floatBitsToUint(_e810) & 2147483647u)) + _e809);
                        float _e823 = ((_e768 * _e814) * (((((_e710 * _e710) + (_e712 * _e712)) + (_e714 * _e714)) + 8.881784e-16) + (0.5 * _e715)));
                        float _e826 = uintBitsToFloat((2129859015u - floatBitsToUint(_e823)));
                        if (_e589) {
                        } else {
                            v38_3 = true;
                            break;
                        }
                        v0_3[_e584.member_1] = ((uintBitsToFloat(((_e597 & 2047u) << 19u)) * (((((_e758 > 0.0) ? _e758 : 0.0) * _e768) + (_e752 * ((_e762 < _e752) ? _e762 : _e752))) * ((((_e810 > 0.0) ? _e810 : 0.0) * _e814) + (_e809 * _e809)))) * (_e826 * (2.0 - (_e823 * _e826))));
                    }
                    continue;
                }
                bool _e834 = v38_3;
                v58_3 = _e834;
                if (_e834) {
                    break;
                }
                float _e835[8] = v0_3;
                bool _e852 = (_e372.member_7 < 20u);
                v39_3 = 0u;
                if (_e852) {
                    bool _e875 = (_e372.member_7 < 10u);
                    v41_3 = _e372.member_7;
                    if (_e875) {
                    } else {
                        v41_3 = (_e372.member_7 - 10u);
                    }
                    uint _e878 = v41_3;
                    v39_3 = (((_e875 ? _e372.member.member.member : _e372.member.member.member_1) >> (((_e878 * 3u) & 31u) & 31u)) & 7u);
                }
                uint _e854 = v39_3;
                v42_3 = _e854;
                if (_e852) {
                } else {
                    uint _e859 = (_e372.member_7 - 20u);
                    bool _e860 = (_e859 < 10u);
                    v40_3 = _e859;
                    if (_e860) {
                    } else {
                        v40_3 = (_e372.member_7 - 30u);
                    }
                    uint _e863 = v40_3;
                    v42_3 = (((_e860 ? _e372.member.member_1.member : _e372.member.member_1.member_1) >> (((_e863 * 3u) & 31u) & 31u)) & 7u);
                }
                uint _e887 = v42_3;
                uint _e892 = (0u - ((_e835[1] > 0.0) ? 1u : 0u));
                uint _e893 = (1u & _e892);
                uint _e897 = (0u - ((_e835[2] > 0.0) ? 1u : 0u));
                uint _e900 = (_e893 ^ ((2u ^ _e893) & _e897));
                uint _e904 = (0u - ((_e835[3] > 0.0) ? 1u : 0u));
                uint _e907 = (_e900 ^ ((3u ^ _e900) & _e904));
                uint _e911 = (0u - ((_e835[4] > 0.0) ? 1u : 0u));
                uint _e914 = (_e907 ^ ((4u ^ _e907) & _e911));
                uint _e918 = (0u - ((_e835[5] > 0.0) ? 1u : 0u));
                uint _e921 = (_e914 ^ ((5u ^ _e914) & _e918));
                uint _e925 = (0u - ((_e835[6] > 0.0) ? 1u : 0u));
                uint _e928 = (_e921 ^ ((6u ^ _e921) & _e925));
                uint _e932 = (0u - ((_e835[7] > 0.0) ? 1u : 0u));
                uint _e935 = (_e928 ^ ((7u ^ _e928) & _e932));
                float _e938 = ((((0.0 + _e835[0]) + _e835[4]) + ((0.0 + _e835[2]) + _e835[6])) + (((0.0 + _e835[1]) + _e835[5]) + ((0.0 + _e835[3]) + _e835[7])));
                bool _e939 = (_e938 > 0.0);
                float _e943 = (_e939 ? _e938 : 1.0);
                uint _e944 = floatBitsToUint(_e943);
                float _e949 = uintBitsToFloat(((_e944 & 2147483648u) | (2129859015u - (_e944 & 2147483647u))));
                float _e952 = (_e949 * (2.0 - (_e943 * _e949)));
                float _e956 = ((float(int(_e372.member_8)) * 0.9999695) * (_e952 * (2.0 - (_e943 * _e952))));
                v43_3 = 2147483647;
                if (_e372.member_13) {
                } else {
                    v43_3 = int((_e372.member_1.member >> 10u));
                }
                int _e959 = v43_3;
                int _e965 = int((floatBitsToUint(((_e835[0] * _e956) + 8388608.0)) & 8388607u));
                int _e972 = (((_e965 > 1) ? _e965 : 1) & int((0u - ((_e835[0] > 0.0) ? 1u : 0u))));
                uint _e973 = uint(_e972);
                uint _e974 = (_e973 & 4294967295u);
                int _e976 = int((_e372.member_13 ? _e887 : _e935));
                uint _e980 = (0u - (((_e972 <= _e959) && (0 < _e976)) ? 1u : 0u));
                uint _e981 = (_e973 & _e980);
                int _e987 = int((floatBitsToUint(((_e835[1] * _e956) + 8388608.0)) & 8388607u));
                int _e992 = (_e972 + (((_e987 > 1) ? _e987 : 1) & int(_e892)));
                uint _e993 = uint(_e992);
                uint _e996 = (_e974 ^ ((_e993 ^ _e974) & _e980));
                uint _e1001 = (0u - (((_e992 <= _e959) && (1 < _e976)) ? 1u : 0u));
                uint _e1004 = (_e981 ^ ((_e993 ^ _e981) & _e1001));
                int _e1011 = int((floatBitsToUint(((_e835[2] * _e956) + 8388608.0)) & 8388607u));
                int _e1016 = (_e992 + (((_e1011 > 1) ? _e1011 : 1) & int(_e897)));
                uint _e1017 = uint(_e1016);
                uint _e1020 = (_e996 ^ ((_e1017 ^ _e996) & _e1001));
                uint _e1025 = (0u - (((_e1016 <= _e959) && (2 < _e976)) ? 1u : 0u));
                uint _e1028 = (_e1004 ^ ((_e1017 ^ _e1004) & _e1025));
                int _e1035 = int((floatBitsToUint(((_e835[3] * _e956) + 8388608.0)) & 8388607u));
                int _e1040 = (_e1016 + (((_e1035 > 1) ? _e1035 : 1) & int(_e904)));
                uint _e1041 = uint(_e1040);
                uint _e1044 = (_e1020 ^ ((_e1041 ^ _e1020) & _e1025));
                uint _e1049 = (0u - (((_e1040 <= _e959) && (3 < _e976)) ? 1u : 0u));
                uint _e1052 = (_e1028 ^ ((_e1041 ^ _e1028) & _e1049));
                int _e1059 = int((floatBitsToUint(((_e835[4] * _e956) + 8388608.0)) & 8388607u));
                int _e1064 = (_e1040 + (((_e1059 > 1) ? _e1059 : 1) & int(_e911)));
                uint _e1065 = uint(_e1064);
                uint _e1068 = (_e1044 ^ ((_e1065 ^ _e1044) & _e1049));
                uint _e1073 = (0u - (((_e1064 <= _e959) && (4 < _e976)) ? 1u : 0u));
                uint _e1076 = (_e1052 ^ ((_e1065 ^ _e1052) & _e1073));
                int _e1083 = int((floatBitsToUint(((_e835[5] * _e956) + 8388608.0)) & 8388607u));
                int _e1088 = (_e1064 + (((_e1083 > 1) ? _e1083 : 1) & int(_e918)));
                uint _e1089 = uint(_e1088);
                uint _e1092 = (_e1068 ^ ((_e1089 ^ _e1068) & _e1073));
                uint _e1097 = (0u - (((_e1088 <= _e959) && (5 < _e976)) ? 1u : 0u));
                uint _e1100 = (_e1076 ^ ((_e1089 ^ _e1076) & _e1097));
                int _e1107 = int((floatBitsToUint(((_e835[6] * _e956) + 8388608.0)) & 8388607u));
                int _e1112 = (_e1088 + (((_e1107 > 1) ? _e1107 : 1) & int(_e925)));
                uint _e1113 = uint(_e1112);
                uint _e1116 = (_e1092 ^ ((_e1113 ^ _e1092) & _e1097));
                uint _e1121 = (0u - (((_e1112 <= _e959) && (6 < _e976)) ? 1u : 0u));
                uint _e1124 = (_e1100 ^ ((_e1113 ^ _e1100) & _e1121));
                int _e1131 = int((floatBitsToUint(((_e835[7] * _e956) + 8388608.0)) & 8388607u));
                int _e1136 = (_e1112 + (((_e1131 > 1) ? _e1131 : 1) & int(_e932)));
                uint _e1137 = uint(_e1136);
                uint _e1140 = (_e1116 ^ ((_e1137 ^ _e1116) & _e1121));
                uint _e1145 = (0u - (((_e1136 <= _e959) && (7 < _e976)) ? 1u : 0u));
                uint _e1148 = (_e1124 ^ ((_e1137 ^ _e1124) & _e1145));
                uint _e1151 = (_e372.member_13 ? _e887 : ((((((((_e980 & 1u) + (_e1001 & 1u)) + (_e1025 & 1u)) + (_e1049 & 1u)) + (_e1073 & 1u)) + (_e1097 & 1u)) + (_e1121 & 1u)) + (_e1145 & 1u)));
                bool _e1156 = (_e1151 < 8u);
                bool _e1157 = ((_e939 && (_e1140 > _e1148)) && _e1156);
                uint _e1158 = (_e1156 ? _e1151 : 0u);
                v44_3 = 0u;
                if (_e1157) {
                    v44_3 = (((_e1151 == _e935) ? _e372.member_8 : _e1140) - _e1148);
                }
                uint _e1162 = v44_3;
                bool _e1163 = (_e1158 < 8u);
                if (_e1163) {
                } else {
                    v58_3 = true;
                    break;
                }
                uint _e1167 = lightbvh_nodes.list[_e377][1u][_e1158];
                uint _e1168 = (_e1167 & 3u);
                if (_e1163) {
                } else {
                    v58_3 = true;
                    break;
                }
                uint _e1172 = lightbvh_nodes.list[_e377][5u][_e1158];
                bool _e1176 = ((_e376 && (_e1162 > 0u)) && (_e1162 <= _e372.member_8));
                uint _e1177 = (_e1176 ? _e1162 : 1u);
                uint _e1179 = ((_e1177 - 1u) & 4194303u);
                uint _e1185 = (((_e1179 == 0u) ? 32u : (uint(31) - uint(findMSB(_e1179)))) - 10u);
                uint _e1187 = ((_e1185 < 22u) ? _e1185 : 22u);
                uint _e1199 = (_e1187 & 31u);
                LightbvhType31_ _e1220 = LightbvhType31_(_e372.member, LightbvhType23_((((_e372.member_1.member - ((_e1157 ? _e1148 : 0u) << 10u)) << _e1199) | ((_e372.member_1.member_1 >> uint(1)) >> ((31u - _e1187) & 31u))), (_e372.member_1.member_1 << _e1199)), _e372.member_2, _e372.member_3, _e372.member_4, _e372.member_5, _e372.member_6, _e372.member_7, _e372.member_8, _e372.member_9, _e372.member_10, _e372.member_11, _e372.member_12, _e372.member_13);
                LightbvhType31_ _e1237 = LightbvhType31_(_e1220.member, _e1220.member_1, _e1220.member_2, _e1220.member_3, _e1220.member_4, _e1220.member_5, _e1220.member_6, _e1220.member_7, (_e1177 << _e1199), _e1220.member_9, _e1220.member_10, _e1220.member_11, _e1220.member_12, _e1220.member_13);
                LightbvhType31_ _e1254 = LightbvhType31_(_e1237.member, _e1237.member_1, _e1237.member_2, _e1237.member_3, _e1237.member_4, _e1237.member_5, _e1237.member_6, _e1237.member_7, _e1237.member_8, (_e372.member_9 + _e1187), _e1237.member_10, _e1237.member_11, _e1237.member_12, _e1237.member_13);
                uint _e1255 = (_e372.member_7 + 1u);
                v45_3 = true;
                if ((_e1255 == 20u)) {
                } else {
                    v45_3 = (_e1255 == 40u);
                }
                bool _e1259 = v45_3;
                uint _e1260 = (_e1172 & 134217727u);
                uint _e1264 = (_e1172 >> (uint(findLSB(134217728u)) & 31u));
                bool _e1268 = (_e1260 < _e145);
                bool _e1269 = (((_e1176 && (_e1168 == 3u)) && _e852) && _e1268);
                bool _e1273 = ((_e1176 && (_e1168 == 1u)) && !(_e1259));
                LightbvhType31_ _e1291 = LightbvhType31_(_e1254.member, _e1254.member_1, _e1254.member_2, _e1254.member_3, _e1254.member_4, ((_e1176 && (_e1168 == 2u)) ? _e1172 : 4294967295u), _e1254.member_6, _e1254.member_7, _e1254.member_8, _e1254.member_9, _e1254.member_10, _e1254.member_11, _e1254.member_12, _e1254.member_13);
                uint _e1293 = (_e372.member_11 - 1u);
                LightbvhType31_ _e1308 = LightbvhType31_(_e1291.member, _e1291.member_1, _e1291.member_2, _e1291.member_3, _e1291.member_4, _e1291.member_5, _e1291.member_6, _e1291.member_7, _e1291.member_8, _e1291.member_9, _e1291.member_10, _e1293, _e1291.member_12, _e1291.member_13);
                bool _e1312 = (!((_e1269 || _e1273)) || (_e1293 == 0u));
                LightbvhType31_ _e1327 = LightbvhType31_(_e1308.member, _e1308.member_1, _e1308.member_2, _e1308.member_3, _e1308.member_4, _e1308.member_5, _e1308.member_6, _e1308.member_7, _e1308.member_8, _e1308.member_9, _e1308.member_10, _e1308.member_11, _e1312, _e1308.member_13);
                v46_3 = LightbvhType31_(LightbvhType24_(LightbvhType23_(0u, 0u), LightbvhType23_(0u, 0u)), LightbvhType23_(0u, 0u), LightbvhType25_(0.0, 0.0), 0u, 0u, 0u, 0u, 0u, 0u, 0u, LightbvhType29_(float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), 0u, false, false);
                if (_e1269) {
                    if (_e1268) {
                    } else {
                        v58_3 = true;
                        break;
                    }
                    LightbvhType31_ _e1380 = LightbvhType31_(_e1327.member, _e1327.member_1, _e1327.member_2, _e1327.member_3, _e1327.member_4, _e1327.member_5, _e1260, _e1327.member_7, _e1327.member_8, _e1327.member_9, _e1327.member_10, _e1327.member_11, _e1327.member_12, _e1327.member_13);
                    uint _e1383 = lightbvh_instances.list[_e1260].root;
                    LightbvhType31_ _e1398 = LightbvhType31_(_e1380.member, _e1380.member_1, _e1380.member_2, _e1380.member_3, _e1383, _e1380.member_5, _e1380.member_6, _e1380.member_7, _e1380.member_8, _e1380.member_9, _e1380.member_10, _e1380.member_11, _e1380.member_12, _e1380.member_13);
                    bool _e1399 = (_e1383 == 4294967295u);
                    v48_3 = 4294967295u;
                    if (_e1399) {
                        uint _e1402 = lightbvh_instances.list[_e1260].first_light;
                        v48_3 = _e1402;
                    }
                    uint _e1404 = v48_3;
                    LightbvhType31_ _e1419 = LightbvhType31_(_e1398.member, _e1398.member_1, _e1398.member_2, _e1398.member_3, _e1398.member_4, _e1404, _e1398.member_6, _e1398.member_7, _e1398.member_8, _e1398.member_9, _e1398.member_10, _e1398.member_11, _e1398.member_12, _e1398.member_13);
                    bool _e1420 = (_e1312 || _e1399);
                    LightbvhType31_ _e1435 = LightbvhType31_(_e1419.member, _e1419.member_1, _e1419.member_2, _e1419.member_3, _e1419.member_4, _e1419.member_5, _e1419.member_6, _e1419.member_7, _e1419.member_8, _e1419.member_9, _e1419.member_10, _e1419.member_11, _e1420, _e1419.member_13);
                    LightbvhType31_ _e1450 = LightbvhType31_(_e1435.member, _e1435.member_1, _e1435.member_2, _e1435.member_3, _e1435.member_4, _e1435.member_5, _e1435.member_6, 20u, _e1435.member_8, _e1435.member_9, _e1435.member_10, _e1435.member_11, _e1435.member_12, _e1435.member_13);
                    v49_3 = _e1450;
                    if ((_e1264 > 0u)) {
                        uint _e1453 = ((_e1383 < _e142) ? _e1383 : 0u);
                        if ((_e1453 < _e142)) {
                        } else {
                            v58_3 = true;
                            break;
                        }
                        uint _e1456 = ((_e1264 - 1u) % 8u);
                        bool _e1457 = (_e1456 < 8u);
                        if (_e1457) {
                        } else {
                            v58_3 = true;
                            break;
                        }
                        uint _e1461 = lightbvh_nodes.list[_e1453][1u][_e1456];
                        uint _e1462 = (_e1461 & 3u);
                        if (_e1457) {
                        } else {
                            v58_3 = true;
                            break;
                        }
                        uint _e1466 = lightbvh_nodes.list[_e1453][5u][_e1456];
                        LightbvhType31_ _e1481 = LightbvhType31_(_e1450.member, _e1450.member_1, _e1450.member_2, _e1450.member_3, _e1466, _e1450.member_5, _e1450.member_6, _e1450.member_7, _e1450.member_8, _e1450.member_9, _e1450.member_10, _e1450.member_11, _e1450.member_12, _e1450.member_13);
                        LightbvhType31_ _e1498 = LightbvhType31_(_e1481.member, _e1481.member_1, _e1481.member_2, _e1481.member_3, _e1481.member_4, ((_e1462 == 2u) ? _e1466 : 4294967295u), _e1481.member_6, _e1481.member_7, _e1481.member_8, _e1481.member_9, _e1481.member_10, _e1481.member_11, _e1481.member_12, _e1481.member_13);
                        LightbvhType31_ _e1515 = LightbvhType31_(_e1498.member, _e1498.member_1, _e1498.member_2, _e1498.member_3, _e1498.member_4, _e1498.member_5, _e1498.member_6, _e1498.member_7, _e1498.member_8, _e1498.member_9, _e1498.member_10, _e1498.member_11, (_e1420 || (_e1462 != 1u)), _e1498.member_13);
                        v49_3 = LightbvhType31_(_e1515.member, _e1515.member_1, _e1515.member_2, _e1515.member_3, _e1515.member_4, _e1515.member_5, _e1515.member_6, 21u, _e1515.member_8, _e1515.member_9, _e1515.member_10, _e1515.member_11, _e1515.member_12, _e1515.member_13);
                    }
                    LightbvhType31_ _e1532 = v49_3;
                    float _e1541 = lightbvh_instances.list[_e1260].translation[0u];
                    float _e1545 = lightbvh_instances.list[_e1260].translation[1u];
                    float _e1549 = lightbvh_instances.list[_e1260].translation[2u];
                    float _e1550 = (_e177.member.member[0] - _e1541);
                    float _e1551 = (_e177.member.member[1] - _e1545);
                    float _e1552 = (_e177.member.member[2] - _e1549);
                    float _e1557 = ((uintBitsToFloat((floatBitsToUint(_e1550) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1550);
                    float _e1562 = ((uintBitsToFloat((floatBitsToUint(_e1551) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1551);
                    float _e1567 = ((uintBitsToFloat((floatBitsToUint(_e1552) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1552);
                    float _e1572 = lightbvh_instances.list[_e1260].inverse_[0u][0u];
                    float _e1577 = lightbvh_instances.list[_e1260].inverse_[0u][1u];
                    float _e1582 = lightbvh_instances.list[_e1260].inverse_[0u][2u];
                    float _e1590 = lightbvh_instances.list[_e1260].inverse_[1u][0u];
                    float _e1595 = lightbvh_instances.list[_e1260].inverse_[1u][1u];
                    float _e1600 = lightbvh_instances.list[_e1260].inverse_[1u][2u];
                    float _e1611 = lightbvh_instances.list[_e1260].inverse_[2u][0u];
                    float _e1616 = lightbvh_instances.list[_e1260].inverse_[2u][1u];
                    float _e1621 = lightbvh_instances.list[_e1260].inverse_[2u][2u];
                    float _e1625 = (((_e1572 * _e1557) + (_e1590 * _e1562)) + (_e1611 * _e1567));
                    float _e1626 = (((_e1577 * _e1557) + (_e1595 * _e1562)) + (_e1616 * _e1567));
                    float _e1627 = (((_e1582 * _e1557) + (_e1600 * _e1562)) + (_e1621 * _e1567));
                    float _e1635 = lightbvh_instances.list[_e1260].columns[0u][0u];
                    float _e1640 = lightbvh_instances.list[_e1260].columns[0u][1u];
                    float _e1645 = lightbvh_instances.list[_e1260].columns[0u][2u];
                    float _e1650 = (((_e1635 * _e177.member.member_2[0]) + (_e1640 * _e177.member.member_2[1])) + (_e1645 * _e177.member.member_2[2]));
                    float _e1655 = lightbvh_instances.list[_e1260].columns[1u][0u];
                    float _e1660 = lightbvh_instances.list[_e1260].columns[1u][1u];
                    float _e1665 = lightbvh_instances.list[_e1260].columns[1u][2u];
                    float _e1670 = (((_e1655 * _e177.member.member_2[0]) + (_e1660 * _e177.member.member_2[1])) + (_e1665 * _e177.member.member_2[2]));
                    float _e1675 = lightbvh_instances.list[_e1260].columns[2u][0u];
                    float _e1680 = lightbvh_instances.list[_e1260].columns[2u][1u];
                    float _e1685 = lightbvh_instances.list[_e1260].columns[2u][2u];
                    float _e1690 = (((_e1675 * _e177.member.member_2[0]) + (_e1680 * _e177.member.member_2[1])) + (_e1685 * _e177.member.member_2[2]));
                    float _e1695 = ((uintBitsToFloat((floatBitsToUint(_e1650) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1650);
                    float _e1700 = ((uintBitsToFloat((floatBitsToUint(_e1670) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1670);
                    float _e1705 = ((uintBitsToFloat((floatBitsToUint(_e1690) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1690);
                    float _e1710 = (((_e1695 * _e1695) + (_e1700 * _e1700)) + (_e1705 * _e1705));
                    float _e1711 = uintBitsToFloat(67108864u);
                    v50_3 = 0.0;
                    if ((_e1710 >= _e1711)) {
                        float _e1717 = uintBitsToFloat((1597463007u - (floatBitsToUint(_e1710) >> uint(1))));
                        float _e1718 = (0.5 * _e1710);
                        float _e1722 = (_e1717 * (1.5 - ((_e1718 * _e1717) * _e1717)));
                        v50_3 = (_e1722 * (1.5 - ((_e1718 * _e1722) * _e1722)));
                    }
                    float _e1728 = v50_3;
                    float _e1729 = -(1.1529215e18);
                    v51_3 = _e1729;
                    if ((_e1625 < _e1729)) {
                    } else {
                        v51_3 = ((_e1625 > 1.1529215e18) ? 1.1529215e18 : _e1625);
                    }
                    float _e1734 = v51_3;
                    v52_3 = _e1729;
                    if ((_e1626 < _e1729)) {
                    } else {
                        v52_3 = ((_e1626 > 1.1529215e18) ? 1.1529215e18 : _e1626);
                    }
                    float _e1744 = v52_3;
                    v53_3 = _e1729;
                    if ((_e1627 < _e1729)) {
                    } else {
                        v53_3 = ((_e1627 > 1.1529215e18) ? 1.1529215e18 : _e1627);
                    }
                    float _e1754 = v53_3;
                    float _e1761 = (_e1695 * _e1728);
                    float _e1767 = (_e1700 * _e1728);
                    float _e1773 = (_e1705 * _e1728);
                    float _e1789 = ((uintBitsToFloat((floatBitsToUint(_e177.member.member_2[0]) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e177.member.member_2[0]);
                    float _e1794 = ((uintBitsToFloat((floatBitsToUint(_e177.member.member_2[1]) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e177.member.member_2[1]);
                    float _e1799 = ((uintBitsToFloat((floatBitsToUint(_e177.member.member_2[2]) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e177.member.member_2[2]);
                    float _e1804 = (((_e1789 * _e1789) + (_e1794 * _e1794)) + (_e1799 * _e1799));
                    float _e1806 = ((_e1804 > _e1711) ? _e1804 : _e1711);
                    float _e1811 = uintBitsToFloat((1597463007u - (floatBitsToUint(_e1806) >> uint(1))));
                    float _e1812 = (0.5 * _e1806);
                    float _e1816 = (_e1811 * (1.5 - ((_e1812 * _e1811) * _e1811)));
                    float _e1821 = (_e1806 * (_e1816 * (1.5 - ((_e1812 * _e1816) * _e1816))));
                    float _e1822 = (((uintBitsToFloat((floatBitsToUint(_e1761) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1761) * _e1821);
                    float _e1823 = (((uintBitsToFloat((floatBitsToUint(_e1767) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1767) * _e1821);
                    float _e1824 = (((uintBitsToFloat((floatBitsToUint(_e1773) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1773) * _e1821);
                    float _e1850 = ((uintBitsToFloat((floatBitsToUint(_e177.member.member_1[0]) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e177.member.member_1[0]);
                    float _e1855 = ((uintBitsToFloat((floatBitsToUint(_e177.member.member_1[1]) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e177.member.member_1[1]);
                    float _e1860 = ((uintBitsToFloat((floatBitsToUint(_e177.member.member_1[2]) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e177.member.member_1[2]);
                    float _e1900 = (((uintBitsToFloat((floatBitsToUint(_e1572) & 2147483647u)) * _e1850) + (uintBitsToFloat((floatBitsToUint(_e1590) & 2147483647u)) * _e1855)) + (uintBitsToFloat((floatBitsToUint(_e1611) & 2147483647u)) * _e1860));
                    float _e1901 = (((uintBitsToFloat((floatBitsToUint(_e1577) & 2147483647u)) * _e1850) + (uintBitsToFloat((floatBitsToUint(_e1595) & 2147483647u)) * _e1855)) + (uintBitsToFloat((floatBitsToUint(_e1616) & 2147483647u)) * _e1860));
                    float _e1902 = (((uintBitsToFloat((floatBitsToUint(_e1582) & 2147483647u)) * _e1850) + (uintBitsToFloat((floatBitsToUint(_e1600) & 2147483647u)) * _e1855)) + (uintBitsToFloat((floatBitsToUint(_e1621) & 2147483647u)) * _e1860));
                    float _e1904 = ((_e1900 < 1.1529215e18) ? _e1900 : 1.1529215e18);
                    float _e1906 = ((_e1901 < 1.1529215e18) ? _e1901 : 1.1529215e18);
                    float _e1908 = ((_e1902 < 1.1529215e18) ? _e1902 : 1.1529215e18);
                    v46_3 = LightbvhType31_(_e1532.member, _e1532.member_1, _e1532.member_2, _e1532.member_3, _e1532.member_4, _e1532.member_5, _e1532.member_6, _e1532.member_7, _e1532.member_8, _e1532.member_9, LightbvhType29_(float[3](((uintBitsToFloat((floatBitsToUint(_e1734) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1734), ((uintBitsToFloat((floatBitsToUint(_e1744) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1744), ((uintBitsToFloat((floatBitsToUint(_e1754) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1754)), float[3](((uintBitsToFloat((floatBitsToUint(_e1904) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1904), ((uintBitsToFloat((floatBitsToUint(_e1906) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1906), ((uintBitsToFloat((floatBitsToUint(_e1908) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1908)), float[3](((uintBitsToFloat((floatBitsToUint(_e1822) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1822), ((uintBitsToFloat((floatBitsToUint(_e1823) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1823), ((uintBitsToFloat((floatBitsToUint(_e1824) & 2147483647u)) < 8.6736174e-19) ? 0.0 : _e1824))), _e1532.member_11, _e1532.member_12, _e1532.member_13);
                }
                LightbvhType31_ _e1329 = v46_3;
                v54_3 = _e1329;
                if (_e1269) {
                } else {
                    v47_3 = _e372.member_4;
                    if (_e1273) {
                        v47_3 = (_e1172 + (_e852 ? _e151 : 0u));
                    }
                    uint _e1333 = v47_3;
                    LightbvhType31_ _e1348 = LightbvhType31_(_e1327.member, _e1327.member_1, _e1327.member_2, _e1327.member_3, _e1333, _e1327.member_5, _e1327.member_6, _e1327.member_7, _e1327.member_8, _e1327.member_9, _e1327.member_10, _e1327.member_11, _e1327.member_12, _e1327.member_13);
                    v54_3 = LightbvhType31_(_e1348.member, _e1348.member_1, _e1348.member_2, _e1348.member_3, _e1348.member_4, _e1348.member_5, _e1348.member_6, (_e372.member_7 + (_e1273 ? 1u : 0u)), _e1348.member_8, _e1348.member_9, _e1348.member_10, _e1348.member_11, _e1348.member_12, _e1348.member_13);
                }
                LightbvhType31_ _e1943 = v54_3;
                v55_3 = _e834;
                v56_3 = _e1943;
                v57_3 = _e1943.member_12;
            }
            bool _e1946 = v55_3;
            LightbvhType31_ _e1948 = v56_3;
            bool _e1950 = v57_3;
            continue;
        }
        bool _e1954 = v58_3;
        if (_e1954) {
            break;
        }
        LightbvhType31_ _e1956 = v59_3;
        LightbvhType31_ _e1960 = v60_3;
        v63_3 = 0.0;
        if ((((_e1956.member_5 == _e201) && (_e1960.member_6 == _e184)) && (_e201 != 4294967295u))) {
            LightbvhType31_ _e1967 = v61_3;
            LightbvhType31_ _e1972 = v62_3;
            int _e1978 = -(int((22u + ((_e1967.member_9 < 98u) ? _e1967.member_9 : 98u))));
            int _e1980 = ((_e1978 < -126) ? -126 : _e1978);
            v63_3 = (float(int(_e1972.member_8)) * uintBitsToFloat((uint((((_e1980 > 127) ? 127 : _e1980) + 127)) << uint(23))));
        }
        float _e1990 = v63_3;
        v65_3 = 0u;
        v66_3 = true;
        if (_e183) {
            v64_3 = 0u;
            if (_e185) {
                if (_e185) {
                } else {
                    break;
                }
                uint _e1993 = lightbvh_instances.list[_e184].count;
                v64_3 = _e1993;
            }
            uint _e1995 = v64_3;
            v65_3 = _e1995;
            v66_3 = (_e185 ? false : true);
        }
        uint _e1998 = v65_3;
        bool _e2000 = v66_3;
        uint _e2005 = ((_e2000 ? _e172 : _e1998) & 2147483647u);
        uint _e2010 = floatBitsToUint((float(65536) * uintBitsToFloat(880803840u)));
        uint _e2011 = floatBitsToUint(float(int(((_e2005 > 0u) ? _e2005 : 1u))));
        uint _e2016 = ((_e2010 >> uint(23)) & 255u);
        uint _e2020 = (_e2010 & 8388607u);
        uint _e2021 = (_e2020 | 8388608u);
        uint _e2022 = (_e2011 & 8388607u);
        uint _e2023 = (_e2022 | 8388608u);
        bool _e2024 = (_e2021 < _e2023);
        float _e2028 = uintBitsToFloat((_e2022 | 1065353216u));
        uint _e2029 = floatBitsToUint(_e2028);
        float _e2034 = uintBitsToFloat(((_e2029 & 2147483648u) | (2129859015u - (_e2029 & 2147483647u))));
        float _e2037 = (_e2034 * (2.0 - (_e2028 * _e2034)));
        float _e2040 = (_e2037 * (2.0 - (_e2028 * _e2037)));
        float _e2044 = ((uintBitsToFloat((_e2020 | 1065353216u)) * _e2040) * (_e2024 ? 16777216.0 : 8388608.0));
        float _e2045 = uintBitsToFloat(0u);
        float _e2046 = uintBitsToFloat(1333788671u);
        uint _e2051 = ((_e2044 > _e2046) ? 4294967295u : ((_e2044 < _e2045) ? 0u : uint(_e2044)));
        int _e2057 = int(((_e2021 << uint(((_e2024 ? 24 : 23) & 31))) - (_e2051 * _e2023)));
        float _e2062 = ((float((_e2057 >> uint(8))) * _e2040) * 3.0517578e-5);
        float _e2063 = uintBitsToFloat(3472883712u);
        float _e2064 = uintBitsToFloat(1325400063u);
        int _e2071 = ((_e2062 == _e2062) ? ((_e2062 > _e2064) ? 2147483647 : ((_e2062 < _e2063) ? -2147483648 : int(_e2062))) : 0);
        uint _e2073 = (_e2051 + uint(_e2071));
        int _e2074 = int(_e2023);
        int _e2076 = (_e2057 - (_e2071 * _e2074));
        bool _e2077 = (_e2076 < 0);
        v67_3 = _e2073;
        if (_e2077) {
            v67_3 = (_e2073 - 1u);
        }
        uint _e2080 = v67_3;
        v68_3 = _e2076;
        if (_e2077) {
            v68_3 = (_e2076 + _e2074);
        }
        int _e2083 = v68_3;
        bool _e2084 = (_e2083 >= _e2074);
        v69_3 = _e2080;
        if (_e2084) {
            v69_3 = (_e2080 + 1u);
        }
        uint _e2087 = v69_3;
        v70_3 = _e2083;
        if (_e2084) {
            v70_3 = (_e2083 - _e2074);
        }
        int _e2090 = v70_3;
        v71_3 = _e2087;
        if (((_e2090 * 2) > _e2074)) {
            v71_3 = (_e2087 + 1u);
        }
        uint _e2095 = v71_3;
        int _e2100 = ((int(_e2016) - int(((_e2011 >> uint(23)) & 255u))) + (_e2024 ? 126 : 127));
        v74_3 = 0u;
        v75_3 = true;
        if ((_e2016 == 0u)) {
        } else {
            bool _e2102 = (_e2100 <= 0);
            v73_3 = 0u;
            if (_e2102) {
            } else {
                v72_3 = 2139095040u;
                if ((_e2100 >= 255)) {
                } else {
                    v72_3 = ((uint(_e2100) << uint(23)) + (_e2095 & 8388607u));
                }
                uint _e2110 = v72_3;
                v73_3 = _e2110;
            }
            uint _e2112 = v73_3;
            v74_3 = _e2112;
            v75_3 = _e2102;
        }
        uint _e2114 = v74_3;
        bool _e2116 = v75_3;
        uint _e2120 = (_e169 & 2147483647u);
        uint _e2125 = floatBitsToUint(uintBitsToFloat((((_e2010 ^ _e2011) & 2147483648u) | (_e2116 ? 0u : _e2114))));
        uint _e2126 = floatBitsToUint(float(int(((_e2120 > 0u) ? _e2120 : 1u))));
        uint _e2131 = ((_e2125 >> uint(23)) & 255u);
        uint _e2135 = (_e2125 & 8388607u);
        uint _e2136 = (_e2135 | 8388608u);
        uint _e2137 = (_e2126 & 8388607u);
        uint _e2138 = (_e2137 | 8388608u);
        bool _e2139 = (_e2136 < _e2138);
        float _e2143 = uintBitsToFloat((_e2137 | 1065353216u));
        uint _e2144 = floatBitsToUint(_e2143);
        float _e2149 = uintBitsToFloat(((_e2144 & 2147483648u) | (2129859015u - (_e2144 & 2147483647u))));
        float _e2152 = (_e2149 * (2.0 - (_e2143 * _e2149)));
        float _e2155 = (_e2152 * (2.0 - (_e2143 * _e2152)));
        float _e2159 = ((uintBitsToFloat((_e2135 | 1065353216u)) * _e2155) * (_e2139 ? 16777216.0 : 8388608.0));
        uint _e2164 = ((_e2159 > _e2046) ? 4294967295u : ((_e2159 < _e2045) ? 0u : uint(_e2159)));
        int _e2170 = int(((_e2136 << uint(((_e2139 ? 24 : 23) & 31))) - (_e2164 * _e2138)));
        float _e2175 = ((float((_e2170 >> uint(8))) * _e2155) * 3.0517578e-5);
        int _e2182 = ((_e2175 == _e2175) ? ((_e2175 > _e2064) ? 2147483647 : ((_e2175 < _e2063) ? -2147483648 : int(_e2175))) : 0);
        uint _e2184 = (_e2164 + uint(_e2182));
        int _e2185 = int(_e2138);
        int _e2187 = (_e2170 - (_e2182 * _e2185));
        bool _e2188 = (_e2187 < 0);
        v76_3 = _e2184;
        if (_e2188) {
            v76_3 = (_e2184 - 1u);
        }
        uint _e2191 = v76_3;
        v77_3 = _e2187;
        if (_e2188) {
            v77_3 = (_e2187 + _e2185);
        }
        int _e2194 = v77_3;
        bool _e2195 = (_e2194 >= _e2185);
        v78_3 = _e2191;
        if (_e2195) {
            v78_3 = (_e2191 + 1u);
        }
        uint _e2198 = v78_3;
        v79_3 = _e2194;
        if (_e2195) {
            v79_3 = (_e2194 - _e2185);
        }
        int _e2201 = v79_3;
        v80_3 = _e2198;
        if (((_e2201 * 2) > _e2185)) {
            v80_3 = (_e2198 + 1u);
        }
        uint _e2206 = v80_3;
        int _e2211 = ((int(_e2131) - int(((_e2126 >> uint(23)) & 255u))) + (_e2139 ? 126 : 127));
        v83_3 = 0u;
        v84_3 = true;
        if ((_e2131 == 0u)) {
        } else {
            bool _e2213 = (_e2211 <= 0);
            v82_3 = 0u;
            if (_e2213) {
            } else {
                v81_3 = 2139095040u;
                if ((_e2211 >= 255)) {
                } else {
                    v81_3 = ((uint(_e2211) << uint(23)) + (_e2206 & 8388607u));
                }
                uint _e2221 = v81_3;
                v82_3 = _e2221;
            }
            uint _e2223 = v82_3;
            v83_3 = _e2223;
            v84_3 = _e2213;
        }
        uint _e2225 = v83_3;
        bool _e2227 = v84_3;
        v85_3 = false;
        if (_e183) {
            v86_3 = false;
            if (_e185) {
                if (_e185) {
                } else {
                    break;
                }
                uint _e2236 = lightbvh_instances.list[_e184].first;
                uint _e2240 = lightbvh_instances.list[_e184].count;
                v86_3 = ((_e177.member_1[0] - _e2236) < _e2240);
            }
            bool _e2243 = v86_3;
            v85_3 = _e2243;
        }
        bool _e2232 = v85_3;
        v87_3 = _e2232;
        if (_e183) {
        } else {
            v87_3 = (_e177.member_1[0] < _e172);
        }
        bool _e2245 = v87_3;
        v88_3 = 0.0;
        if (_e2245) {
            v88_3 = (_e1990 + uintBitsToFloat((((_e2125 ^ _e2126) & 2147483648u) | (_e2227 ? 0u : _e2225))));
        }
        float _e2248 = v88_3;
        results_3 = _e2248;
        break;
    } while(false);
    float _e2339 = results_3;
    return _e2339;
}

LightbvhLightPoint lightbvh_light_point(uint light_2, uint instance_2, vec2 numbers) {
    LightbvhType19_ samples = LightbvhType19_(0u, 0u, 0.0);
    float numbers_1[2] = float[2](0.0, 0.0);
    LightbvhType38_ results_4 = LightbvhType38_(float[3](0.0, 0.0, 0.0), 0.0, float[3](0.0, 0.0, 0.0), 0u, float[3](0.0, 0.0, 0.0));
    float v0_4 = 0.0;
    float v1_4 = 0.0;
    float v2_4 = 0.0;
    float v3_4 = 0.0;
    float v4_4 = 0.0;
    float v5_4 = 0.0;
    float v6_4 = 0.0;
    float v7_4 = 0.0;
    float v8_4 = 0.0;
    float v9_4[3] = float[3](0.0, 0.0, 0.0);
    float v10_4[3] = float[3](0.0, 0.0, 0.0);
    float v11_4 = 0.0;
    float v12_4 = 0.0;
    float v13_4 = 0.0;
    LightbvhLight v14_4 = LightbvhLight(float[3][3](float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), float[3](0.0, 0.0, 0.0), 0u, 0u);
    LightbvhLight v15_4 = LightbvhLight(float[3][3](float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), float[3](0.0, 0.0, 0.0), 0u, 0u);
    LightbvhLight v16_4 = LightbvhLight(float[3][3](float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), float[3](0.0, 0.0, 0.0), 0u, 0u);
    uint v17_4 = 0u;
    int v18_4 = 0;
    int v19_4 = 0;
    uint v20_4 = 0u;
    uint v21_4 = 0u;
    float v22_4 = 0.0;
    uint v23_4 = 0u;
    int v24_4 = 0;
    uint v25_4 = 0u;
    int v26_4 = 0;
    uint v27_4 = 0u;
    uint v28_4 = 0u;
    uint v29_4 = 0u;
    float v30_4 = 0.0;
    float v31_4 = 0.0;
    float v32_4[3] = float[3](0.0, 0.0, 0.0);
    samples = LightbvhType19_(light_2, instance_2, 0.0);
    numbers_1 = float[2](numbers.x, numbers.y);
    do {
        uint _e77 = samples.member;
        uint _e80 = samples.member_1;
        uint _e82 = ((_e80 == 4294967295u) ? 0u : _e80);
        bool _e83 = (_e82 < uint(lightbvh_instances.list.length()));
        v16_4 = LightbvhLight(float[3][3](float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), float[3](0.0, 0.0, 0.0), 4294967295u, 0u);
        if (_e83) {
            if (_e83) {
            } else {
                break;
            }
            LightbvhInstance _e86 = lightbvh_instances.list[_e82];
            uint _e88 = (_e77 - _e86.first);
            uint _e90 = (_e88 + _e86.first_light);
            v15_4 = LightbvhLight(float[3][3](float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), float[3](0.0, 0.0, 0.0), 4294967295u, 0u);
            if ((_e88 < _e86.count)) {
                bool _e93 = (_e90 < uint(lightbvh_lights.list.length()));
                v14_4 = LightbvhLight(float[3][3](float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0), float[3](0.0, 0.0, 0.0)), float[3](0.0, 0.0, 0.0), 4294967295u, 0u);
                if (_e93) {
                    if (_e93) {
                    } else {
                        break;
                    }
                    LightbvhLight _e96 = lightbvh_lights.list[_e90];
                    float _e115 = (_e86.columns[0][0] * _e96.p[0][0]);
                    float _e116 = (_e86.columns[0][1] * _e96.p[0][0]);
                    float _e117 = (_e86.columns[0][2] * _e96.p[0][0]);
                    float _e127 = (_e86.columns[1][0] * _e96.p[0][1]);
                    float _e128 = (_e86.columns[1][1] * _e96.p[0][1]);
                    float _e129 = (_e86.columns[1][2] * _e96.p[0][1]);
                    float _e139 = (_e86.columns[2][0] * _e96.p[0][2]);
                    float _e140 = (_e86.columns[2][1] * _e96.p[0][2]);
                    float _e141 = (_e86.columns[2][2] * _e96.p[0][2]);
                    float _e199 = (((((uintBitsToFloat((floatBitsToUint(_e115) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e115) + ((uintBitsToFloat((floatBitsToUint(_e127) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e127)) + ((uintBitsToFloat((floatBitsToUint(_e139) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e139)) + _e86.translation[0]);
                    float _e200 = (((((uintBitsToFloat((floatBitsToUint(_e116) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e116) + ((uintBitsToFloat((floatBitsToUint(_e128) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e128)) + ((uintBitsToFloat((floatBitsToUint(_e140) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e140)) + _e86.translation[1]);
                    float _e201 = (((((uintBitsToFloat((floatBitsToUint(_e117) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e117) + ((uintBitsToFloat((floatBitsToUint(_e129) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e129)) + ((uintBitsToFloat((floatBitsToUint(_e141) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e141)) + _e86.translation[2]);
                    float _e202 = -(1099511600000.0);
                    v0_4 = _e202;
                    if ((_e199 < _e202)) {
                    } else {
                        v0_4 = ((_e199 > 1099511600000.0) ? 1099511600000.0 : _e199);
                    }
                    float _e207 = v0_4;
                    v1_4 = _e202;
                    if ((_e200 < _e202)) {
                    } else {
                        v1_4 = ((_e200 > 1099511600000.0) ? 1099511600000.0 : _e200);
                    }
                    float _e217 = v1_4;
                    v2_4 = _e202;
                    if ((_e201 < _e202)) {
                    } else {
                        v2_4 = ((_e201 > 1099511600000.0) ? 1099511600000.0 : _e201);
                    }
                    float _e227 = v2_4;
                    float _e237 = (_e86.columns[0][0] * _e96.p[1][0]);
                    float _e238 = (_e86.columns[0][1] * _e96.p[1][0]);
                    float _e239 = (_e86.columns[0][2] * _e96.p[1][0]);
                    float _e240 = (_e86.columns[1][0] * _e96.p[1][1]);
                    float _e241 = (_e86.columns[1][1] * _e96.p[1][1]);
                    float _e242 = (_e86.columns[1][2] * _e96.p[1][1]);
                    float _e243 = (_e86.columns[2][0] * _e96.p[1][2]);
                    float _e244 = (_e86.columns[2][1] * _e96.p[1][2]);
                    float _e245 = (_e86.columns[2][2] * _e96.p[1][2]);
                    float _e297 = (((((uintBitsToFloat((floatBitsToUint(_e237) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e237) + ((uintBitsToFloat((floatBitsToUint(_e240) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e240)) + ((uintBitsToFloat((floatBitsToUint(_e243) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e243)) + _e86.translation[0]);
                    float _e298 = (((((uintBitsToFloat((floatBitsToUint(_e238) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e238) + ((uintBitsToFloat((floatBitsToUint(_e241) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e241)) + ((uintBitsToFloat((floatBitsToUint(_e244) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e244)) + _e86.translation[1]);
                    float _e299 = (((((uintBitsToFloat((floatBitsToUint(_e239) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e239) + ((uintBitsToFloat((floatBitsToUint(_e242) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e242)) + ((uintBitsToFloat((floatBitsToUint(_e245) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e245)) + _e86.translation[2]);
                    v3_4 = _e202;
                    if ((_e297 < _e202)) {
                    } else {
                        v3_4 = ((_e297 > 1099511600000.0) ? 1099511600000.0 : _e297);
                    }
                    float _e304 = v3_4;
                    v4_4 = _e202;
                    if ((_e298 < _e202)) {
                    } else {
                        v4_4 = ((_e298 > 1099511600000.0) ? 1099511600000.0 : _e298);
                    }
                    float _e314 = v4_4;
                    v5_4 = _e202;
                    if ((_e299 < _e202)) {
                    } else {
                        v5_4 = ((_e299 > 1099511600000.0) ? 1099511600000.0 : _e299);
                    }
                    float _e324 = v5_4;
                    float _e330[3] = float[3](((uintBitsToFloat((floatBitsToUint(_e304) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e304), ((uintBitsToFloat((floatBitsToUint(_e314) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e314), ((uintBitsToFloat((floatBitsToUint(_e324) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e324));
                    float _e334 = (_e86.columns[0][0] * _e96.p[2][0]);
                    float _e335 = (_e86.columns[0][1] * _e96.p[2][0]);
                    float _e336 = (_e86.columns[0][2] * _e96.p[2][0]);
                    float _e337 = (_e86.columns[1][0] * _e96.p[2][1]);
                    float _e338 = (_e86.columns[1][1] * _e96.p[2][1]);
                    float _e339 = (_e86.columns[1][2] * _e96.p[2][1]);
                    float _e340 = (_e86.columns[2][0] * _e96.p[2][2]);
                    float _e341 = (_e86.columns[2][1] * _e96.p[2][2]);
                    float _e342 = (_e86.columns[2][2] * _e96.p[2][2]);
                    float _e394 = (((((uintBitsToFloat((floatBitsToUint(_e334) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e334) + ((uintBitsToFloat((floatBitsToUint(_e337) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e337)) + ((uintBitsToFloat((floatBitsToUint(_e340) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e340)) + _e86.translation[0]);
                    float _e395 = (((((uintBitsToFloat((floatBitsToUint(_e335) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e335) + ((uintBitsToFloat((floatBitsToUint(_e338) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e338)) + ((uintBitsToFloat((floatBitsToUint(_e341) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e341)) + _e86.translation[1]);
                    float _e396 = (((((uintBitsToFloat((floatBitsToUint(_e336) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e336) + ((uintBitsToFloat((floatBitsToUint(_e339) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e339)) + ((uintBitsToFloat((floatBitsToUint(_e342) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e342)) + _e86.translation[2]);
                    v6_4 = _e202;
                    if ((_e394 < _e202)) {
                    } else {
                        v6_4 = ((_e394 > 1099511600000.0) ? 1099511600000.0 : _e394);
                    }
                    float _e401 = v6_4;
                    v7_4 = _e202;
                    if ((_e395 < _e202)) {
                    } else {
                        v7_4 = ((_e395 > 1099511600000.0) ? 1099511600000.0 : _e395);
                    }
                    float _e411 = v7_4;
                    v8_4 = _e202;
                    if ((_e396 < _e202)) {
                    } else {
                        v8_4 = ((_e396 > 1099511600000.0) ? 1099511600000.0 : _e396);
                    }
                    float _e421 = v8_4;
                    float _e427[3] = float[3](((uintBitsToFloat((floatBitsToUint(_e401) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e401), ((uintBitsToFloat((floatBitsToUint(_e411) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e411), ((uintBitsToFloat((floatBitsToUint(_e421) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e421));
                    bool _e430 = ((_e86.mirrored & 1u) != 0u);
                    v9_4 = _e330;
                    if (_e430) {
                        v9_4 = _e427;
                    }
                    float _e432[3] = v9_4;
                    v10_4 = _e427;
                    if (_e430) {
                        v10_4 = _e330;
                    }
                    float _e434[3] = v10_4;
                    float _e436 = (_e96.p[1][0] - _e96.p[0][0]);
                    float _e437 = (_e96.p[1][1] - _e96.p[0][1]);
                    float _e438 = (_e96.p[1][2] - _e96.p[0][2]);
                    float _e439 = (_e96.p[2][0] - _e96.p[0][0]);
                    float _e440 = (_e96.p[2][1] - _e96.p[0][1]);
                    float _e441 = (_e96.p[2][2] - _e96.p[0][2]);
                    float _e444 = uintBitsToFloat((floatBitsToUint(_e436) & 2147483647u));
                    float _e447 = uintBitsToFloat((floatBitsToUint(_e437) & 2147483647u));
                    float _e450 = uintBitsToFloat((floatBitsToUint(_e438) & 2147483647u));
                    float _e453 = uintBitsToFloat((floatBitsToUint(_e439) & 2147483647u));
                    float _e456 = uintBitsToFloat((floatBitsToUint(_e440) & 2147483647u));
                    float _e459 = uintBitsToFloat((floatBitsToUint(_e441) & 2147483647u));
                    float _e468 = uintBitsToFloat((floatBitsToUint(((_e444 > _e453) ? _e444 : _e453)) & 2147483647u));
                    float _e471 = uintBitsToFloat((floatBitsToUint(((_e447 > _e456) ? _e447 : _e456)) & 2147483647u));
                    float _e474 = uintBitsToFloat((floatBitsToUint(((_e450 > _e459) ? _e450 : _e459)) & 2147483647u));
                    float _e476 = ((_e468 > _e471) ? _e468 : _e471);
                    int _e484 = (int(((floatBitsToUint(((_e476 > _e474) ? _e476 : _e474)) >> uint(23)) & 255u)) - 127);
                    int _e486 = ((_e484 > -127) ? _e484 : -127);
                    int _e487 = -(_e486);
                    int _e489 = ((_e487 < -126) ? -126 : _e487);
                    float _e496 = uintBitsToFloat((uint((((_e489 > 127) ? 127 : _e489) + 127)) << uint(23)));
                    float _e497 = (_e436 * _e496);
                    float _e498 = (_e437 * _e496);
                    float _e499 = (_e438 * _e496);
                    float _e500 = (_e439 * _e496);
                    float _e501 = (_e440 * _e496);
                    float _e502 = (_e441 * _e496);
                    float _e514 = uintBitsToFloat((floatBitsToUint(((_e498 * _e502) - (_e499 * _e501))) & 2147483647u));
                    float _e517 = uintBitsToFloat((floatBitsToUint(((_e499 * _e500) - (_e497 * _e502))) & 2147483647u));
                    float _e520 = uintBitsToFloat((floatBitsToUint(((_e497 * _e501) - (_e498 * _e500))) & 2147483647u));
                    float _e522 = ((_e514 > _e517) ? _e514 : _e517);
                    int _e530 = (int(((floatBitsToUint(((_e522 > _e520) ? _e522 : _e520)) >> uint(23)) & 255u)) - 127);
                    bool _e548 = (((((_e530 > -127) ? _e530 : -127) >= -100) && (_e486 > -127)) && ((((0.2126 * _e96.radiance[0]) + (0.7152 * _e96.radiance[1])) + (0.0722 * _e96.radiance[2])) > 0.0));
                    float _e551 = (_e96.radiance[0] * _e86.radiance[0]);
                    v11_4 = 7.888609e-31;
                    if ((_e551 < 7.888609e-31)) {
                    } else {
                        v11_4 = ((_e551 > 1.2676506e30) ? 1.2676506e30 : _e551);
                    }
                    float _e556 = v11_4;
                    float _e564 = (_e96.radiance[1] * _e86.radiance[1]);
                    v12_4 = 7.888609e-31;
                    if ((_e564 < 7.888609e-31)) {
                    } else {
                        v12_4 = ((_e564 > 1.2676506e30) ? 1.2676506e30 : _e564);
                    }
                    float _e569 = v12_4;
                    float _e577 = (_e96.radiance[2] * _e86.radiance[2]);
                    v13_4 = 7.888609e-31;
                    if ((_e577 < 7.888609e-31)) {
                    } else {
                        v13_4 = ((_e577 > 1.2676506e30) ? 1.2676506e30 : _e577);
                    }
                    float _e582 = v13_4;
                    v14_4 = LightbvhLight(float[3][3](float[3](((uintBitsToFloat((floatBitsToUint(_e207) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e207), ((uintBitsToFloat((floatBitsToUint(_e217) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e217), ((uintBitsToFloat((floatBitsToUint(_e227) & 2147483647u)) < 7.888609e-31) ? 0.0 : _e227)), _e432, _e434), float[3](((((_e96.radiance[0] > 0.0) && (_e86.radiance[0] > 0.0)) && _e548) ? _e556 : 0.0), ((((_e96.radiance[1] > 0.0) && (_e86.radiance[1] > 0.0)) && _e548) ? _e569 : 0.0), ((((_e96.radiance[2] > 0.0) && (_e86.radiance[2] > 0.0)) && _e548) ? _e582 : 0.0)), _e82, _e96.flags);
                }
                LightbvhLight _e592 = v14_4;
                v15_4 = _e592;
            }
            LightbvhLight _e594 = v15_4;
            v16_4 = _e594;
        }
        LightbvhLight _e596 = v16_4;
        float _e598[2] = numbers_1;
        float _e609 = (_e596.p[1][0] - _e596.p[0][0]);
        float _e610 = (_e596.p[1][1] - _e596.p[0][1]);
        float _e611 = (_e596.p[1][2] - _e596.p[0][2]);
        float _e617 = (_e596.p[2][0] - _e596.p[0][0]);
        float _e618 = (_e596.p[2][1] - _e596.p[0][1]);
        float _e619 = (_e596.p[2][2] - _e596.p[0][2]);
        float _e622 = uintBitsToFloat((floatBitsToUint(_e609) & 2147483647u));
        float _e625 = uintBitsToFloat((floatBitsToUint(_e610) & 2147483647u));
        float _e628 = uintBitsToFloat((floatBitsToUint(_e611) & 2147483647u));
        float _e631 = uintBitsToFloat((floatBitsToUint(_e617) & 2147483647u));
        float _e634 = uintBitsToFloat((floatBitsToUint(_e618) & 2147483647u));
        float _e637 = uintBitsToFloat((floatBitsToUint(_e619) & 2147483647u));
        float _e646 = uintBitsToFloat((floatBitsToUint(((_e622 > _e631) ? _e622 : _e631)) & 2147483647u));
        float _e649 = uintBitsToFloat((floatBitsToUint(((_e625 > _e634) ? _e625 : _e634)) & 2147483647u));
        float _e652 = uintBitsToFloat((floatBitsToUint(((_e628 > _e637) ? _e628 : _e637)) & 2147483647u));
        float _e654 = ((_e646 > _e649) ? _e646 : _e649);
        int _e662 = (int(((floatBitsToUint(((_e654 > _e652) ? _e654 : _e652)) >> uint(23)) & 255u)) - 127);
        int _e664 = ((_e662 > -127) ? _e662 : -127);
        int _e665 = -(_e664);
        int _e667 = ((_e665 < -126) ? -126 : _e665);
        float _e674 = uintBitsToFloat((uint((((_e667 > 127) ? 127 : _e667) + 127)) << uint(23)));
        float _e675 = (_e609 * _e674);
        float _e676 = (_e610 * _e674);
        float _e677 = (_e611 * _e674);
        float _e678 = (_e617 * _e674);
        float _e679 = (_e618 * _e674);
        float _e680 = (_e619 * _e674);
        float _e683 = ((_e676 * _e680) - (_e677 * _e679));
        float _e686 = ((_e677 * _e678) - (_e675 * _e680));
        float _e689 = ((_e675 * _e679) - (_e676 * _e678));
        float _e692 = uintBitsToFloat((floatBitsToUint(_e683) & 2147483647u));
        float _e695 = uintBitsToFloat((floatBitsToUint(_e686) & 2147483647u));
        float _e698 = uintBitsToFloat((floatBitsToUint(_e689) & 2147483647u));
        float _e700 = ((_e692 > _e695) ? _e692 : _e695);
        int _e708 = (int(((floatBitsToUint(((_e700 > _e698) ? _e700 : _e698)) >> uint(23)) & 255u)) - 127);
        int _e710 = ((_e708 > -127) ? _e708 : -127);
        bool _e711 = (_e710 >= -100);
        int _e714 = -(_e710);
        int _e716 = ((_e714 < -126) ? -126 : _e714);
        float _e723 = uintBitsToFloat((uint((((_e716 > 127) ? 127 : _e716) + 127)) << uint(23)));
        uint _e728 = (0u - ((_e711 && (_e664 > -127)) ? 1u : 0u));
        float _e731 = uintBitsToFloat((floatBitsToUint((_e683 * _e723)) & _e728));
        float _e734 = uintBitsToFloat((floatBitsToUint((_e686 * _e723)) & _e728));
        float _e739 = uintBitsToFloat((1065353216u ^ ((floatBitsToUint((_e689 * _e723)) ^ 1065353216u) & _e728)));
        uint _e745 = floatBitsToUint((((_e731 * _e731) + (_e734 * _e734)) + (_e739 * _e739)));
        uint _e748 = ((_e745 >> uint(23)) & 255u);
        uint _e750 = ((_e748 & 1u) ^ 1u);
        uint _e751 = (_e745 & 8388607u);
        float _e757 = uintBitsToFloat((_e751 | (1065353216u + (_e750 << uint(23)))));
        float _e763 = uintBitsToFloat((1597463007u - (floatBitsToUint(_e757) >> uint(1))));
        float _e764 = (0.5 * _e757);
        float _e768 = (_e763 * (1.5 - ((_e764 * _e763) * _e763)));
        float _e772 = (_e768 * (1.5 - ((_e764 * _e768) * _e768)));
        float _e776 = (_e772 * (1.5 - ((_e764 * _e772) * _e772)));
        float _e778 = ((_e757 * _e776) * 8388608.0);
        float _e779 = uintBitsToFloat(0u);
        float _e780 = uintBitsToFloat(1333788671u);
        uint _e785 = ((_e778 > _e780) ? 4294967295u : ((_e778 < _e779) ? 0u : uint(_e778)));
        uint _e788 = ((_e751 | 8388608u) << ((23u + _e750) & 31u));
        float _e796 = ((float((int((_e788 - (_e785 * _e785))) >> uint(8))) * _e776) * 1.5258789e-5);
        float _e797 = uintBitsToFloat(3472883712u);
        float _e798 = uintBitsToFloat(1325400063u);
        uint _e807 = (_e785 + uint(((_e796 == _e796) ? ((_e796 > _e798) ? 2147483647 : ((_e796 < _e797) ? -2147483648 : int(_e796))) : 0)));
        int _e810 = int((_e788 - (_e807 * _e807)));
        bool _e811 = (_e810 < 0);
        v17_4 = _e807;
        if (_e811) {
            v17_4 = (_e807 - 1u);
        }
        uint _e814 = v17_4;
        v18_4 = _e810;
        if (_e811) {
            v18_4 = (_e810 + ((2 * int(_e814)) + 1));
        }
        int _e820 = v18_4;
        int _e822 = (2 * int(_e814));
        bool _e823 = (_e820 > _e822);
        v19_4 = _e820;
        if (_e823) {
            v19_4 = (_e820 - (_e822 + 1));
        }
        int _e827 = v19_4;
        v20_4 = _e814;
        if (_e823) {
            v20_4 = (_e814 + 1u);
        }
        uint _e830 = v20_4;
        v21_4 = _e830;
        if ((_e827 > int(_e830))) {
            v21_4 = (_e830 + 1u);
        }
        uint _e835 = v21_4;
        v22_4 = 0.0;
        if ((int(_e745) < 8388608)) {
        } else {
            v22_4 = uintBitsToFloat((((((_e748 + 127u) - _e750) >> uint(1)) << uint(23)) + (_e835 - 8388608u)));
        }
        float _e848 = v22_4;
        uint _e849 = floatBitsToUint(_e848);
        uint _e855 = (_e849 & 8388607u);
        uint _e856 = (_e855 | 8388608u);
        bool _e857 = (8388608u < _e856);
        float _e861 = uintBitsToFloat((_e855 | 1065353216u));
        uint _e862 = floatBitsToUint(_e861);
        float _e867 = uintBitsToFloat(((_e862 & 2147483648u) | (2129859015u - (_e862 & 2147483647u))));
        float _e870 = (_e867 * (2.0 - (_e861 * _e867)));
        float _e873 = (_e870 * (2.0 - (_e861 * _e870)));
        float _e876 = ((uintBitsToFloat(1065353216u) * _e873) * (_e857 ? 16777216.0 : 8388608.0));
        uint _e881 = ((_e876 > _e780) ? 4294967295u : ((_e876 < _e779) ? 0u : uint(_e876)));
        int _e887 = int(((8388608u << uint(((_e857 ? 24 : 23) & 31))) - (_e881 * _e856)));
        float _e892 = ((float((_e887 >> uint(8))) * _e873) * 3.0517578e-5);
        int _e899 = ((_e892 == _e892) ? ((_e892 > _e798) ? 2147483647 : ((_e892 < _e797) ? -2147483648 : int(_e892))) : 0);
        uint _e901 = (_e881 + uint(_e899));
        int _e902 = int(_e856);
        int _e904 = (_e887 - (_e899 * _e902));
        bool _e905 = (_e904 < 0);
        v23_4 = _e901;
        if (_e905) {
            v23_4 = (_e901 - 1u);
        }
        uint _e908 = v23_4;
        v24_4 = _e904;
        if (_e905) {
            v24_4 = (_e904 + _e902);
        }
        int _e911 = v24_4;
        bool _e912 = (_e911 >= _e902);
        v25_4 = _e908;
        if (_e912) {
            v25_4 = (_e908 + 1u);
        }
        uint _e915 = v25_4;
        v26_4 = _e911;
        if (_e912) {
            v26_4 = (_e911 - _e902);
        }
        int _e918 = v26_4;
        v27_4 = _e915;
        if (((_e918 * 2) > _e902)) {
            v27_4 = (_e915 + 1u);
        }
        uint _e923 = v27_4;
        int _e927 = ((127 - int(((_e849 >> uint(23)) & 255u))) + (_e857 ? 126 : 127));
        bool _e928 = (_e927 <= 0);
        v29_4 = 0u;
        if (_e928) {
        } else {
            v28_4 = 2139095040u;
            if ((_e927 >= 255)) {
            } else {
                v28_4 = ((uint(_e927) << uint(23)) + (_e923 & 8388607u));
            }
            uint _e936 = v28_4;
            v29_4 = _e936;
        }
        uint _e938 = v29_4;
        float _e941 = uintBitsToFloat((((1065353216u ^ _e849) & 2147483648u) | (_e928 ? 0u : _e938)));
        int _e945 = -(((_e710 + _e664) + _e664));
        int _e947 = ((_e945 < -126) ? -126 : _e945);
        float _e955 = ((_e941 + _e941) * uintBitsToFloat((uint((((_e947 > 127) ? 127 : _e947) + 127)) << uint(23))));
        bool _e959 = ((_e598[0] + _e598[1]) > 1.0);
        v30_4 = _e598[0];
        if (_e959) {
            v30_4 = (1.0 - _e598[0]);
        }
        float _e962 = v30_4;
        v31_4 = _e598[1];
        if (_e959) {
            v31_4 = (1.0 - _e598[1]);
        }
        float _e965 = v31_4;
        float _e966 = (_e609 * _e962);
        float _e967 = (_e610 * _e962);
        float _e968 = (_e611 * _e962);
        float _e987 = (_e617 * _e965);
        float _e988 = (_e618 * _e965);
        float _e989 = (_e619 * _e965);
        v32_4 = float[3](0.0, 0.0, 0.0);
        if (_e711) {
            v32_4 = float[3]((_e731 * _e941), (_e734 * _e941), (_e739 * _e941));
        }
        float _e1019[3] = v32_4;
        results_4 = LightbvhType38_(float[3](((_e596.p[0][0] + ((uintBitsToFloat((floatBitsToUint(_e966) & 2147483647u)) < 9.8607613e-32) ? 0.0 : _e966)) + ((uintBitsToFloat((floatBitsToUint(_e987) & 2147483647u)) < 9.8607613e-32) ? 0.0 : _e987)), ((_e596.p[0][1] + ((uintBitsToFloat((floatBitsToUint(_e967) & 2147483647u)) < 9.8607613e-32) ? 0.0 : _e967)) + ((uintBitsToFloat((floatBitsToUint(_e988) & 2147483647u)) < 9.8607613e-32) ? 0.0 : _e988)), ((_e596.p[0][2] + ((uintBitsToFloat((floatBitsToUint(_e968) & 2147483647u)) < 9.8607613e-32) ? 0.0 : _e968)) + ((uintBitsToFloat((floatBitsToUint(_e989) & 2147483647u)) < 9.8607613e-32) ? 0.0 : _e989))), (_e711 ? ((_e955 < 1.329228e36) ? _e955 : 1.329228e36) : 0.0), _e1019, _e596.flags, _e596.radiance);
        break;
    } while(false);
    LightbvhType38_ _e1056 = results_4;
    return LightbvhLightPoint(vec3(_e1056.member[0], _e1056.member[1], _e1056.member[2]), _e1056.member_1, vec3(_e1056.member_2[0], _e1056.member_2[1], _e1056.member_2[2]), _e1056.member_3, vec3(_e1056.member_4[0], _e1056.member_4[1], _e1056.member_4[2]));
}
